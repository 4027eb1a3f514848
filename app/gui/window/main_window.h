#pragma once

#include <QMainWindow>
#include <memory>
#include <optional>

#include "debug/open_run.h"
#include "frame/actions.h"
#include "frame/frame.h"
#include "frame/status_line.h"
#include "reality/reality_marks.h"
#include "session/session.h"
#include "widgets/theme.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace mrose {
class RolloutStrip;
class FieldView;
class Inspector;
class MessageBar;
}  // namespace mrose

namespace mrose::gui {

class BackgroundWork;
class BranchPanel;
class BreakpointPanel;
class CommandPanel;
class ErrorPlot;
class FocusRing;
class Overlay;
class OverlayPanel;
class PlotPanel;
class SideView;
class WindowFiles;
class WindowMemory;
class WorkProgress;

/// The window. It shows what the session shows, and turns what the user does into requests.
class MainWindow final : public QMainWindow {
    Q_OBJECT

public:
    explicit MainWindow(QWidget* parent = nullptr);
    ~MainWindow() override;

    /// Opens a scenario, a recording or one that ships, by its name. Errors are shown, too.
    Expected<void> open(const QString& name);
    /// Its number, as Shown::run will have it.
    std::uint64_t show(const OpenRun& run);
    const QString& runName() const { return title_; }  ///< of what is open
    Session& session() { return *session_; }
    TimelineBar& timeline() const { return *timeline_; }
    FieldView& field() const;
    FieldView& besideField() const;
    Inspector& inspector() const { return *inspector_; }
    PlotPanel& plots() const { return *plots_; }
    ErrorPlot& errorPlot() const { return *errors_; }
    void showPlots() { showDock("plots"); }
    void showDock(const char* name);
    void showReality();  ///< its dock on top of those that it shares the left with, where it is hidden
    CommandPanel& commandPanel() const { return *command_; }
    BranchPanel& branchPanel() const { return *branches_; }
    Overlay& overlay() const { return *overlay_; }
    OverlayPanel& overlayPanel() const { return *reality_; }
    RolloutStrip& rolloutStrip() const { return *strip_; }
    BreakpointPanel& breakpointPanel() const { return *breakpoints_; }
    void setSideBySide(bool on);
    /// Marks on the timeline that the run does not know of: its first divergence. For as long as it is open.
    void note(std::vector<TimelineBar::Content::Noted> marks);
    /// Asks the user for a line; empty: the user cancelled.
    QString askText(const QString& title, const QString& label, const QString& suggestion = {});
    const Shown* shown() const { return session_->current(); }
    const std::shared_ptr<const Shown>& shownPointer() const { return session_->currentPointer(); }
    Actions& actions() { return actions_; }
    MessageBar& messages() const { return *messages_; }
    WindowFiles& files() const { return *files_; }
    WindowMemory& memory() const { return *memory_; }
    BackgroundWork& background() const { return *background_; }
    WorkProgress& progress() const { return *progress_; }
    void changeSpeed(int by);  ///< steps of the list of speeds
    /// Simulated seconds per second, one of the list from now on; 0: as fast as possible.
    void setSpeed(double speed);
    void setTheme(const Theme& theme);
    StatusLine& status() const { return *status_; }
    const QString& said() const { return status_->said(); }
    void say(const QString& text) { status_->say(text); }
    QuietMessage& quietMessage() const { return status_->quietMessage(); }
    /// The window as it is, or a part of it, as PNG, SVG or PDF.
    Expected<void> saveImage(const QString& path, QWidget* part = nullptr);

protected:
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void closeEvent(QCloseEvent* event) override;
    bool event(QEvent* event) override;

private:
    void makeActions();
    void connectAll();
    void makeToolBar();
    void makeDocks();
    void makeStatusBar();
    Session* newSession();
    void update();
    void prepare(const OpenRun& run);
    void markDivergences();
    void updateTimeline();
    void updateStatus();
    void lookAtKick(std::size_t robot);
    void moveBody(std::size_t body, const Pose& pose);

    Frame frame() { return {*this, *session_, actions_, *messages_, *status_, *memory_}; }

    Actions actions_;
    Session* session_;
    SideView* view_;
    TimelineBar* timeline_;
    Inspector* inspector_;
    PlotPanel* plots_;
    BranchPanel* branches_;
    BreakpointPanel* breakpoints_;
    CommandPanel* command_;
    QComboBox* speed_;
    QToolButton* seed_;
    QLabel *clock_, *factor_, *cursor_;
    StatusLine* status_;
    MessageBar* messages_;
    FocusRing* focusRing_;
    WindowMemory* memory_;
    WindowFiles* files_;
    BackgroundWork* background_;
    Overlay* overlay_;
    WorkProgress* progress_;
    OverlayPanel* reality_;
    RolloutStrip* strip_;
    ErrorPlot* errors_ = nullptr;
    RealityMarks realityMarks_;
    std::int64_t plannedTicks_ = 0;
    QString title_;
    Theme theme_ = Theme::light();
};

}  // namespace mrose::gui
