#include <QDockWidget>
#include <QFileDialog>
#include <QTabWidget>

#include "main_window.h"
#include "overlay.h"
#include "overlay_panel.h"
#include "overlay_strip.h"
#include "shared/resources.h"
#include "widgets/field_view.h"
#include "window_actions.h"

namespace mrose::gui {
namespace {

/// A log is a folder or a file: of an MRCLAM folder any of its files will do.
QString askForLog(MainWindow& window) {
    const QString file =
        QFileDialog::getOpenFileName(&window, QObject::tr("Open a real log"), QString(),
                                     QObject::tr("Logs (*.csv *_Odometry.dat *_Groundtruth.dat);;All files (*)"));
    return file.endsWith(".dat") ? QFileInfo(file).path() : file;
}

Expected<void> openLogAt(MainWindow& window, const QString& path) {
    const OverlayRequest request{placeOfLog(path.toStdString()), ""};
    if (window.actions().unattended()) return window.overlay().openNow(request);
    window.overlay().open(request);
    return {};
}

/// The dock beside those that it shares the left with, on top.
void showReality(MainWindow& window) {
    auto* reality = window.findChild<QDockWidget*>("reality");
    if (!reality->isHidden()) return;
    reality->show();
    for (const char* const name : {"branches", "breakpoints", "command"})
        if (auto* dock = window.findChild<QDockWidget*>(name);
            !dock->isHidden() && !dock->isFloating() && window.dockWidgetArea(dock) == window.dockWidgetArea(reality))
            window.tabifyDockWidget(reality, dock);
    window.setTabPosition(Qt::LeftDockWidgetArea, QTabWidget::West);
    reality->raise();
}

QString askForModel(MainWindow& window) {
    return QFileDialog::getOpenFileName(&window, QObject::tr("Motion network"), QString(),
                                        QObject::tr("Networks (*.net);;All files (*)"));
}

/// The robot of the overlay that a body of the run is.
std::optional<std::size_t> robotOf(MainWindow& window, std::optional<std::size_t> body) {
    if (!body || !window.shown() || !window.overlay().world() || *body >= window.shown()->frame->scene().bodyCount())
        return {};
    const std::vector<ComparedRobot>& robots = window.overlay().world()->world().robots();
    const std::string name = window.shown()->frame->nameOf(*body);
    for (std::size_t robot = 0; robot < robots.size(); ++robot)
        if (robots[robot].name == name) return robot;
    return {};
}

/// Selection, strip and panel follow the overlay, and it them.
void bindOverlay(MainWindow& window) {
    Overlay& overlay = window.overlay();
    CourseStrip& strip = window.courseStrip();
    strip.setObjectName("courses_strip");
    strip.hide();
    QObject::connect(&overlay, &Overlay::changed, &window, [&window, &overlay, &strip] {
        strip.setVisible(overlay.world() != nullptr);
        strip.setContent(stripOf(overlay));
        if (overlay.world()) showReality(window);
    });
    QObject::connect(&window, &MainWindow::updated, &strip, [&window, &strip] {
        const FieldFrame& frame = *window.shown()->frame;
        if (frame.reality) strip.setNow(frame.reality->start + frame.scene().timeOf(frame.state.tick));
    });
    QObject::connect(&strip, &CourseStrip::courseRequested, &overlay,
                     [&overlay](std::size_t course) { overlay.show(course, overlay.shownRobot()); });
    QObject::connect(&window.field(), &FieldView::bodySelected, &overlay,
                     [&window, &overlay](auto body) { overlay.setRobot(robotOf(window, body)); });
    QObject::connect(&window.overlayPanel(), &OverlayPanel::modelFileWanted, &window,
                     [&window] { window.actions()["add_model"].trigger(); });
}

}  // namespace

void addOverlayActions(MainWindow& window) {
    Actions& actions = window.actions();
    const QString file = QObject::tr("&File");
    actions.add(file,
                {"open_log", QObject::tr("Open a real &log\u2026"), QKeySequence("Ctrl+L"),
                 QObject::tr("Lay a log of real robots over their simulation")},
                Actions::Asking{[&] { return askForLog(window); },
                                [&](const QString& path) { return openLogAt(window, path); }});
    const QString menu = QObject::tr("&Reality");
    const auto whileOpen = [&](QAction* action) {
        action->setEnabled(false);
        QObject::connect(&window.overlay(), &Overlay::changed, action,
                         [&window, action] { action->setEnabled(window.overlay().world() != nullptr); });
    };
    whileOpen(actions.add(menu,
                          {"next_course", QObject::tr("&Next course"), QKeySequence("Ctrl+PgDown"),
                           QObject::tr("The course after the shown one")},
                          [&](bool) { window.overlay().showNext(1); }));
    whileOpen(actions.add(menu,
                          {"previous_course", QObject::tr("&Previous course"), QKeySequence("Ctrl+PgUp"),
                           QObject::tr("The course before the shown one")},
                          [&](bool) { window.overlay().showNext(-1); }));
    whileOpen(actions.add(menu,
                          {"go_to_divergence", QObject::tr("Where it &leaves the real course"), QKeySequence("D"),
                           QObject::tr("To the first divergence of the shown course")},
                          [&](bool) {
                              if (!window.overlay().goToDivergence())
                                  window.say(QObject::tr("Nothing leaves the real course here by more than the bound"));
                          }));
    actions.addSeparator(menu);
    whileOpen(actions.add(menu,
                          {"add_model", QObject::tr("Lay another &model over\u2026"), QKeySequence("Ctrl+M"),
                           QObject::tr("Show what another motion model makes of the same commands")},
                          Actions::Asking{[&] { return askForModel(window); },
                                          [&](const QString& model) -> Expected<void> {
                                              window.overlay().addModel(model.toStdString());
                                              return {};
                                          }}));
    whileOpen(actions.add(
        menu,
        {"close_log", QObject::tr("&Close the log"), QKeySequence("Ctrl+Shift+W"), QObject::tr("Go on without it")},
        [&](bool) { window.overlay().close(); }));
    bindOverlay(window);
}

}  // namespace mrose::gui
