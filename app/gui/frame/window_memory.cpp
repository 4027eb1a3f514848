#include "frame/window_memory.h"

#include <QDir>
#include <QFileInfo>
#include <QGuiApplication>
#include <QMainWindow>
#include <QMenu>
#include <QScreen>
#include <QUrl>
#include <algorithm>
#include <optional>

#include "frame/actions.h"
#include "frame/docks.h"
#include "session/session.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr int mostRecent = 10;
constexpr const char *geometryKey = "window/geometry", *recentKey = "recent_files", *errorPlotKey = "view/error_plot",
                     *saveFolderKey = "save_folder";

/// Those that are switched to the user's taste and stay so.
bool isTaste(const QString& action) { return action == "dark" || action.startsWith("layer_"); }

template <class Each>
void forTastes(Actions& actions, const Each& each) {
    for (const Actions::Group& group : actions.groups())
        for (QAction* action : group.actions)
            if (action->isCheckable() && isTaste(action->objectName())) each(*action);
}

QString keyOf(const char* group, const QString& file) {
    return QString(group) + '/' + QString::fromLatin1(QUrl::toPercentEncoding(file, {}, "."));
}

QString breaksKey(const QString& file) { return keyOf("breakpoints", file); }

/// "on once 3 robot[2].speed > 0.5"
QString breakLine(const Breakpoint& breakpoint) {
    return QString("%1 %2 %3 %4")
        .arg(breakpoint.enabled ? "on" : "off", breakpoint.oneShot ? "once" : "always")
        .arg(breakpoint.from)
        .arg(qtText(breakpoint.text));
}

std::optional<Breakpoint> breakOf(const QString& line) {
    Breakpoint breakpoint;
    breakpoint.enabled = line.section(' ', 0, 0) == "on";
    breakpoint.oneShot = line.section(' ', 1, 1) == "once";
    breakpoint.from = std::max(1, line.section(' ', 2, 2).toInt());
    breakpoint.text = line.section(' ', 3).toStdString();
    if (breakpoint.text.empty()) return {};
    return breakpoint;
}

/// Frame and all within the screen.
QSize withinScreen(const QSize& size) {
    const QSize frame(8, 40);
    return size.boundedTo(QGuiApplication::primaryScreen()->availableSize() - frame);
}

QString tasteKey(const QAction& action) { return "view/" + action.objectName(); }

}  // namespace

WindowMemory::WindowMemory(QMainWindow& window, Actions& actions, Session& session, Docks& docks)
    : QObject(&window), window_(window), actions_(actions), session_(session), docks_(docks) {}

std::unique_ptr<QSettings> WindowMemory::ofUser() {
    return std::make_unique<QSettings>(QSettings::IniFormat, QSettings::UserScope, "mrose", "mrose-gui");
}

void WindowMemory::restore(std::unique_ptr<QSettings> settings) {
    settings_ = std::move(settings);
    forTastes(actions_, [this](QAction& action) {
        const QVariant kept = settings_->value(tasteKey(action));
        if (kept.isValid() && kept.toBool() != action.isChecked()) action.trigger();
    });
    if (!window_.restoreGeometry(settings_->value(geometryKey).toByteArray()))
        window_.resize(withinScreen(window_.size()));
    docks_.restore(*settings_);
    recent_ = settings_->value(recentKey).toStringList();
    saveFolder_ = settings_->value(saveFolderKey).toString();
    errorPlot_ = settings_->value(errorPlotKey, true).toBool();
}

void WindowMemory::save() {
    if (!settings_) return;
    settings_->setValue(geometryKey, window_.saveGeometry());
    docks_.save(*settings_);
    forTastes(actions_, [this](const QAction& action) { settings_->setValue(tasteKey(action), action.isChecked()); });
    settings_->sync();
}

void WindowMemory::keepAsNew() {
    newSize_ = window_.size();
    docks_.keepAsNew();
}

void WindowMemory::resetLayout() {
    const bool fillsScreen = window_.isMaximized() || window_.isFullScreen();
    if (!fillsScreen) window_.resize(settings_ ? withinScreen(newSize_) : newSize_);
    docks_.reset();
    setErrorPlot(true);
    emit layoutReset();
}

void WindowMemory::setErrorPlot(bool on) {
    errorPlot_ = on;
    if (settings_) settings_->setValue(errorPlotKey, on);
}

QString WindowMemory::lastFolder() const {
    for (const QString& file : recent_)
        if (const QFileInfo place(file); place.isAbsolute() && place.dir().exists()) return place.path();
    return {};
}

QString WindowMemory::saveFolder() const {
    return !saveFolder_.isEmpty() && QFileInfo(saveFolder_).isDir() ? saveFolder_ : lastFolder();
}

void WindowMemory::keepSaveFolder(const QString& file) {
    saveFolder_ = QFileInfo(file).absolutePath();
    if (settings_) settings_->setValue(saveFolderKey, saveFolder_);
}

void WindowMemory::addRecent(const QString& file) {
    changeRecent([&] {
        recent_.removeAll(file);
        recent_.prepend(file);
        while (recent_.size() > mostRecent) recent_.removeLast();
    });
}

void WindowMemory::forgetRecent(const QString& file) {
    changeRecent([&] { recent_.removeAll(file); });
}

void WindowMemory::clearRecent() {
    changeRecent([this] { recent_.clear(); });
}

/// Another window may have changed it meanwhile.
void WindowMemory::changeRecent(const std::function<void()>& change) {
    if (settings_) {
        settings_->sync();
        recent_ = settings_->value(recentKey).toStringList();
    }
    change();
    if (!settings_) return;
    settings_->setValue(recentKey, recent_);
    settings_->sync();
}

QString WindowMemory::robotOf(const QString& log) const {
    return settings_ ? settings_->value(keyOf("robots", log)).toString() : QString();
}

void WindowMemory::keepRobot(const QString& log, const QString& robotFile) {
    if (settings_) settings_->setValue(keyOf("robots", log), robotFile);
}

void WindowMemory::keepBreakpoints(const Shown& shown) {
    if (!settings_ || breaksOf_.isEmpty() || shown.run != breaksRun_) return;
    QStringList lines;
    for (const BreakpointState& state : shown.breakpoints) lines << breakLine(state.breakpoint);
    if (lines == breaks_) return;
    breaks_ = lines;
    settings_->setValue(breaksKey(breaksOf_), lines);
}

void WindowMemory::restoreBreakpoints(const QString& file, std::uint64_t run) {
    breaksOf_ = file;
    breaksRun_ = run;
    breaks_.clear();
    if (!settings_ || breaksOf_.isEmpty() || !settings_->contains(breaksKey(breaksOf_))) return;
    std::vector<Breakpoint> breakpoints;
    for (const QString& line : settings_->value(breaksKey(breaksOf_)).toStringList())
        if (const auto breakpoint = breakOf(line)) breakpoints.push_back(*breakpoint);
    session_.setBreakpoints(breakpoints);
}

void WindowMemory::fillRecent(QMenu& menu, std::function<void(const QString&)> open) {
    connect(&menu, &QMenu::aboutToShow, this, [this, &menu, open = std::move(open)] {
        menu.clear();
        int number = 0;
        for (const QString& file : recent_) {
            const QFileInfo place(file);
            const QString folder = place.isAbsolute() ? "  \u2013  " + place.path() : QString();
            QString text = place.fileName() + folder;
            text.replace('&', "&&");
            QAction* action = menu.addAction((++number < 10 ? QString("&%1  ").arg(number) : QString()) + text);
            action->setToolTip(file);
            connect(action, &QAction::triggered, this, [open, file] { open(file); });
        }
        if (recent_.isEmpty()) menu.addAction(tr("Nothing yet"))->setEnabled(false);
        menu.addSeparator();
        QAction* forget = menu.addAction(tr("&Forget all of them"));
        forget->setEnabled(!recent_.isEmpty());
        connect(forget, &QAction::triggered, this, &WindowMemory::clearRecent);
    });
}

}  // namespace mrose::gui
