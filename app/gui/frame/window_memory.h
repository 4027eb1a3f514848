#pragma once

#include <QObject>
#include <QSettings>
#include <QSize>
#include <QStringList>
#include <cstdint>
#include <functional>
#include <memory>

#include "debug/shown.h"

class QMainWindow;
class QMenu;

namespace mrose::gui {

class Actions;
class Docks;
class Session;

/// What the window keeps from one start to the next: where its docks are, its size, colours, layers, and the files that
/// were opened last. Scripts and pictures made without a display have none, so that they come out the same anywhere.
class WindowMemory final : public QObject {
    Q_OBJECT

public:
    WindowMemory(QMainWindow& window, Actions& actions, Session& session, Docks& docks);

    /// The user's settings file.
    static std::unique_ptr<QSettings> ofUser();

    /// Takes the window's present layout for that of a new one.
    void keepAsNew();
    /// As these settings say; they are kept up to date from now on. Without them nothing outlives the window.
    void restore(std::unique_ptr<QSettings> settings);
    void save();
    /// Docks and tool bars as in a new window; its size, too, unless it fills the screen.
    void resetLayout();

    /// The latest first.
    const QStringList& recentFiles() const { return recent_; }
    QString lastFolder() const;  ///< where the last of them is that is still there; may be empty
    /// Where files were saved last, if that is still there; otherwise lastFolder(). A folder that was saved itself
    /// counts as a file.
    QString saveFolder() const;
    void keepSaveFolder(const QString& file);
    void addRecent(const QString& file);
    void forgetRecent(const QString& file);
    void clearRecent();
    /// The robot file that was chosen for a log, which does not say what drove; empty: none was.
    QString robotOf(const QString& log) const;
    void keepRobot(const QString& log, const QString& robotFile);
    /// The breakpoints of the run that is shown, by the file for which they were restored.
    void keepBreakpoints(const Shown& shown);
    /// Those of a file to a run that has just been opened from it, by its number.
    void restoreBreakpoints(const QString& file, std::uint64_t run);

    /// Whether the errors of a log's rollouts are plotted unasked: until the user closes the plots.
    bool errorPlot() const { return errorPlot_; }
    void setErrorPlot(bool on);

    /// Fills a menu whenever it is about to be shown.
    void fillRecent(QMenu& menu, std::function<void(const QString&)> open);

signals:
    void layoutReset();  ///< what is opened by what is shown may be opened again

private:
    void changeRecent(const std::function<void()>& change);

    QMainWindow& window_;
    Actions& actions_;
    Session& session_;
    Docks& docks_;
    std::unique_ptr<QSettings> settings_;
    QSize newSize_;
    bool errorPlot_ = true;
    QStringList recent_;
    QString saveFolder_;
    QString breaksOf_;             ///< the file whose breakpoints are kept now
    std::uint64_t breaksRun_ = 0;  ///< and the run that was opened from it
    QStringList breaks_;           ///< as they were kept last
};

}  // namespace mrose::gui
