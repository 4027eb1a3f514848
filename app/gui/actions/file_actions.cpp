#include <QFileDialog>
#include <QMenu>

#include "actions/window_actions.h"
#include "export/view_export.h"
#include "files/window_files.h"
#include "frame/window_memory.h"
#include "logs/log_reader.h"
#include "panels/log_dialog.h"
#include "reality/overlay.h"
#include "widgets/field_view.h"
#include "window/main_window.h"
#include "window/work_progress.h"

namespace mrose::gui {
namespace {

QString askForFile(MainWindow& window) {
    LogDialog dialog(&window, QObject::tr("Open"), window.memory().lastFolder(),
                     QObject::tr("What mrose opens (*.toml *.mcap *.net *.csv);;Scenarios (*.toml);;"
                                 "Recordings (*.mcap);;Networks (*.net);;Results of a batch (*.csv);;All files (*)"));
    return dialog.ask();
}

/// The view as the extension says.
Expected<void> savePicture(MainWindow& window, const QString& path) {
    FieldView& field = window.field();
    return writePicture({field.size(), field.logicalDpiX(), window.windowTitle(),
                         [&field](QPainter& painter) { field.paint(painter, field.size()); }},
                        path);
}

/// A name with an extension of its kind, which the ending that is suggested has.
QString askForName(MainWindow& window, const QString& title, const QString& kinds, const QString& ending) {
    QString path = QFileDialog::getSaveFileName(&window, title, window.files().suggestedName(ending), kinds);
    if (!path.isEmpty() && QFileInfo(path).suffix().isEmpty()) path += ending.mid(ending.lastIndexOf('.'));
    return path;
}

/// Scripts wait until it is open, people need not.
Expected<void> openPath(MainWindow& window, const QString& path) {
    if (window.actions().unattended() && looksLikeLog(path.toStdString()))
        return window.overlay().openNow({path.toStdString(), ""});
    if (window.actions().unattended()) return window.files().openNow({path.toStdString()});
    window.files().open(path);
    return {};
}

}  // namespace

void addFileActions(MainWindow& window) {
    Actions& actions = window.actions();
    const QString menu = QObject::tr("&File");
    actions.add(menu,
                {"open", QObject::tr("&Open\u2026"), QKeySequence("Ctrl+O"),
                 QObject::tr("Open a scenario, a recording or a network")},
                Actions::Asking{[&] { return askForFile(window); },
                                [&](const QString& path) { return openPath(window, path); }});
    addOpenLog(window);
    QMenu* recent = actions.menu(menu)->addMenu(QObject::tr("Open &recent"));
    recent->setToolTipsVisible(true);
    window.memory().fillRecent(*recent, [&](const QString& file) { window.files().open(file); });
    actions.add(menu,
                {"reload", QObject::tr("R&eload"), QKeySequence("F5"),
                 QObject::tr("Read the descriptions again, and simulate up to the same tick")},
                [&](bool) { window.files().reload(QObject::tr("Reloaded")); });
    actions.addSeparator(menu);
    actions.add(menu,
                {"save_recording", QObject::tr("&Save recording\u2026"), QKeySequence("Ctrl+S"),
                 QObject::tr("Save the run and all its branches")},
                Actions::Asking{[&] {
                                    return askForName(window, QObject::tr("Save recording"),
                                                      QObject::tr("Recordings (*.mcap)"), ".mcap");
                                },
                                [&](const QString& path) { return window.files().saveRecording(path); }});
    actions.add(
        menu,
        {"record_to", QObject::tr("Re&cord to\u2026"), QKeySequence("Ctrl+Shift+R"),
         QObject::tr("Write the run to a file while it goes on, with what was before")},
        Actions::Asking{
            [&] { return askForName(window, QObject::tr("Record to"), QObject::tr("Recordings (*.mcap)"), ".mcap"); },
            [&](const QString& path) -> Expected<void> {
                window.files().record(path);
                return {};
            }});
    QAction* stop = actions.add(menu,
                                {"stop_recording", QObject::tr("S&top recording"), QKeySequence("Ctrl+Shift+E"),
                                 QObject::tr("Close the file that the run is written to")},
                                [&](bool) { window.files().record({}); });
    stop->setEnabled(false);
    QObject::connect(&window.files(), &WindowFiles::recordingTo, stop,
                     [stop](const QString& path) { stop->setEnabled(!path.isEmpty()); });
    actions.add(menu,
                {"save_scenario", QObject::tr("Sa&ve state as scenario\u2026"), QKeySequence("Ctrl+Shift+S"),
                 QObject::tr("Save a scenario that goes on from the shown tick")},
                Actions::Asking{[&] {
                                    return askForName(window, QObject::tr("Save state as scenario"),
                                                      QObject::tr("Scenarios (*.toml)"), "_state.toml");
                                },
                                [&](const QString& path) { return window.files().saveScenario(path); }});
    actions.add(menu,
                {"save_image", QObject::tr("Save &picture\u2026"), QKeySequence("Ctrl+P"),
                 QObject::tr("Save the field view as PNG, SVG or PDF")},
                Actions::Asking{[&] {
                                    return askForName(window, QObject::tr("Save picture"),
                                                      QObject::tr("Pictures (*.png *.svg *.pdf)"), ".png");
                                },
                                [&](const QString& path) {
                                    auto saved = savePicture(window, path);
                                    if (saved) window.say(QObject::tr("Saved %1").arg(path));
                                    return saved;
                                }});
    actions.addSeparator(menu);
    actions.add(menu,
                {"cancel", QObject::tr("C&ancel or dismiss"), QKeySequence(Qt::Key_Escape),
                 QObject::tr("End what takes long; otherwise dismiss the newest message")},
                [&](bool) { window.progress().cancel(); });
    actions.add(menu, {"quit", QObject::tr("&Quit"), QKeySequence("Ctrl+Q"), QObject::tr("End the program")},
                [&](bool) { window.close(); });
}

}  // namespace mrose::gui
