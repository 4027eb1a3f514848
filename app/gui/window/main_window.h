#pragma once

#include <QMainWindow>
#include <memory>

#include "debug/opened_run.h"
#include "export/exports.h"
#include "frame/actions.h"
#include "frame/status_line.h"
#include "frame/window_frame.h"
#include "scripting/scripted_window.h"
#include "session/session.h"
#include "widgets/theme.h"

class QLabel;

namespace mrose {
class FieldView;
class Inspector;
class MessageBar;
class RolloutStrip;
class TimelineBar;
}  // namespace mrose

namespace mrose::gui {

class BranchPanel;
class BreakpointPanel;
class CommandPanel;
class Docks;
class FieldBands;
class FocusRing;
class RunTimeline;
class SideView;

/// The window: makes its parts, and puts each in its place.
class MainWindow final : public QMainWindow {
    Q_OBJECT

public:
    explicit MainWindow(QWidget* parent = nullptr);
    ~MainWindow() override;

    /// Opens a scenario, a recording or one that ships, by its name. Errors are shown, too.
    Expected<void> open(const QString& name);
    /// Its number, as Shown::run will have it.
    std::uint64_t show(const OpenedRun& run) { return session_->open(run); }
    Session& session() { return *session_; }
    const Shown* shown() const { return session_->current().get(); }
    const WindowFrame& frame() const { return frame_; }
    const Exports& exports() const { return exports_; }
    ScriptedWindow scripted() const;
    Actions& actions() { return actions_; }
    TimelineBar& timeline() const { return *timeline_; }
    RunTimeline& runTimeline() const { return *runTimeline_; }
    SideView& view() const { return *view_; }
    FieldView& field() const;
    Inspector& inspector() const { return *inspector_; }
    PlotPanel& plots() const { return *plots_; }
    ErrorPlot& errorPlot() const { return *errors_; }
    CommandPanel& commandPanel() const { return *command_; }
    BranchPanel& branchPanel() const { return *branches_; }
    BreakpointPanel& breakpointPanel() const { return *breakpoints_; }
    TimeBar& timeBar() const { return *time_; }
    FieldBands& bands() const { return *bands_; }
    Overlay& overlay() const { return *overlay_; }
    OverlayPanel& overlayPanel() const { return *reality_; }
    RolloutStrip& rolloutStrip() const { return *strip_; }
    MessageBar& messages() const { return *messages_; }
    WindowFiles& files() const { return *files_; }
    BackgroundWork& background() const { return *background_; }
    void setTheme(const Theme& theme);

protected:
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    bool event(QEvent* event) override;

private:
    void makeDocks();
    void makeActions();
    void makeStatusBar();
    void connectAll();
    Session* newSession();
    void update();
    void lookAtKick(std::size_t robot);

    Actions actions_;
    Session* session_;
    SideView* view_;
    TimelineBar* timeline_;
    Inspector* inspector_;
    PlotPanel* plots_;
    BranchPanel* branches_;
    BreakpointPanel* breakpoints_;
    CommandPanel* command_;
    QLabel *clock_, *cursor_;
    StatusLine* status_;
    MessageBar* messages_;
    FocusRing* focusRing_;
    Docks* docks_;
    WindowMemory* memory_;
    WindowFrame frame_;
    TimeBar* time_;
    WindowFiles* files_;
    BackgroundWork* background_;
    Overlay* overlay_;
    WorkProgress* progress_;
    OverlayPanel* reality_;
    RolloutStrip* strip_;
    RunTimeline* runTimeline_;
    FieldBands* bands_;
    ErrorPlot* errors_ = nullptr;
    Exports exports_;
};

}  // namespace mrose::gui
