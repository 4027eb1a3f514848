#include <QFileDialog>
#include <QSvgGenerator>

#include "main_window.h"
#include "widgets/field_view.h"
#include "window_actions.h"

namespace mrose::gui {
namespace {

void askForFile(MainWindow& window) {
    const QString path = QFileDialog::getOpenFileName(&window, QObject::tr("Open"), QString(),
                                                      QObject::tr("Scenarios (*.toml);;All files (*)"));
    if (!path.isEmpty()) window.open(path);
}

void askForImage(MainWindow& window) {
    const QString path = QFileDialog::getSaveFileName(&window, QObject::tr("Save picture"), QString(),
                                                      QObject::tr("Pictures (*.png *.svg)"));
    if (!path.isEmpty() && !window.saveImage(path)) window.say(QObject::tr("%1 cannot be written").arg(path));
}

}  // namespace

void addFileActions(MainWindow& window) {
    Actions& actions = window.actions();
    const QString menu = QObject::tr("&File");
    actions.add(menu, {"open", QObject::tr("&Open\u2026"), QKeySequence("Ctrl+O"), QObject::tr("Open a scenario")},
                [&](bool) { askForFile(window); });
    actions.add(menu,
                {"save_image", QObject::tr("Save &picture\u2026"), QKeySequence("Ctrl+P"),
                 QObject::tr("Save the field view as PNG or SVG")},
                [&](bool) { askForImage(window); });
    actions.addSeparator(menu);
    actions.add(menu, {"quit", QObject::tr("&Quit"), QKeySequence("Ctrl+Q"), QObject::tr("End the program")},
                [&](bool) { window.close(); });
}

}  // namespace mrose::gui
