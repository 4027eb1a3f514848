#include <QFileDialog>

#include "main_window.h"
#include "window_actions.h"

namespace mrose::gui {
namespace {

QString askForFile(MainWindow& window) {
    return QFileDialog::getOpenFileName(&window, QObject::tr("Open"), QString(),
                                        QObject::tr("Scenarios (*.toml);;All files (*)"));
}

QString askForImage(MainWindow& window) {
    return QFileDialog::getSaveFileName(&window, QObject::tr("Save picture"), QString(),
                                        QObject::tr("Pictures (*.png *.svg)"));
}

}  // namespace

void addFileActions(MainWindow& window) {
    Actions& actions = window.actions();
    const QString menu = QObject::tr("&File");
    actions.add(
        menu, {"open", QObject::tr("&Open\u2026"), QKeySequence("Ctrl+O"), QObject::tr("Open a scenario")},
        Actions::Asking{[&] { return askForFile(window); }, [&](const QString& path) { return window.open(path); }});
    actions.add(menu,
                {"save_image", QObject::tr("Save &picture\u2026"), QKeySequence("Ctrl+P"),
                 QObject::tr("Save the field view as PNG or SVG")},
                Actions::Asking{[&] { return askForImage(window); },
                                [&](const QString& path) -> Expected<void> {
                                    if (!window.saveImage(path)) return fail(path.toStdString(), "cannot be written");
                                    return {};
                                }});
    actions.addSeparator(menu);
    actions.add(menu, {"quit", QObject::tr("&Quit"), QKeySequence("Ctrl+Q"), QObject::tr("End the program")},
                [&](bool) { window.close(); });
}

}  // namespace mrose::gui
