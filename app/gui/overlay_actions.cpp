#include <QDockWidget>
#include <QFileDialog>

#include "main_window.h"
#include "overlay.h"
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
    const OverlayRequest request{logPlaceOf(path.toStdString()), ""};
    if (window.actions().unattended()) return window.overlay().openNow(request);
    window.overlay().open(request);
    return {};
}

/// The dock beside those that it shares the left with, on top.
void showReality(MainWindow& window) {
    auto* reality = window.findChild<QDockWidget*>("reality");
    if (!reality->isHidden()) return;
    reality->show();
    for (const char* const name : {"command", "branches"})
        if (auto* dock = window.findChild<QDockWidget*>(name);
            !dock->isHidden() && !dock->isFloating() && window.dockWidgetArea(dock) == window.dockWidgetArea(reality))
            window.tabifyDockWidget(dock, reality);
    reality->raise();
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
    QObject::connect(&window.overlay(), &Overlay::changed, &window, [&window] {
        if (window.overlay().world()) showReality(window);
    });
}

}  // namespace mrose::gui
