#pragma once

#include <QObject>
#include <QSettings>
#include <QSize>
#include <QStringList>
#include <functional>
#include <memory>
#include <vector>

class QMenu;

namespace mrose::gui {

struct BreakpointState;

class MainWindow;

/// What the window keeps from one start to the next: where its docks are, its size, colours, layers, and the files that
/// were opened last. Scripts and pictures made without a display have none, so that they come out the same anywhere.
class WindowMemory final : public QObject {
    Q_OBJECT

public:
    explicit WindowMemory(MainWindow& window);

    /// The user's settings file.
    static std::unique_ptr<QSettings> ofUser();

    /// Takes the window's present layout for that of a new one.
    void keepAsNew();
    /// As these settings say; they are kept up to date from now on. Without them nothing outlives the window.
    void restore(std::unique_ptr<QSettings> settings);
    void save();
    /// Docks, tool bars and size as in a new window.
    void resetLayout();

    /// The latest first.
    const QStringList& recentFiles() const { return recent_; }
    QString lastFolder() const;  ///< where the last of them is that is still there; may be empty
    void addRecent(const QString& file);
    void forgetRecent(const QString& file);
    void clearRecent();
    /// The breakpoints of the run that is open, by the file that it was opened from.
    void keepBreakpoints(const std::vector<BreakpointState>& states);
    void restoreBreakpoints();

    /// Fills a menu whenever it is about to be shown.
    void fillRecent(QMenu& menu, std::function<void(const QString&)> open);

private:
    void changeRecent(const std::function<void()>& change);

    MainWindow& window_;
    std::unique_ptr<QSettings> settings_;
    QSize newSize_;
    QByteArray newState_;
    QStringList recent_;
    QString breaksOf_;    ///< the file whose breakpoints are kept now
    QStringList breaks_;  ///< as they were kept last
};

}  // namespace mrose::gui
