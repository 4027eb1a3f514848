#include <QFileDialog>
#include <QMenu>

#include "actions/window_actions.h"
#include "export/view_export.h"
#include "files/window_files.h"
#include "frame/actions.h"
#include "frame/window_memory.h"
#include "frame/work_progress.h"
#include "logs/log_reader.h"
#include "panels/log_dialog.h"
#include "reality/overlay.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

QString askForFile(const WindowFrame& frame) {
    LogDialog dialog(&frame.window, QObject::tr("Open"), frame.memory.lastFolder(),
                     QObject::tr("What mrose opens (*.toml *.mcap *.net *.csv *.dat);;Scenarios (*.toml);;"
                                 "Recordings (*.mcap);;Networks (*.net);;Logs (*.csv *.dat);;Results of a batch "
                                 "(*.csv);;All files (*)"));
    return dialog.ask();
}

QString askForLog(const WindowFrame& frame) {
    LogDialog dialog(&frame.window, QObject::tr("Open a real log"), frame.memory.lastFolder(),
                     QObject::tr("Logs (*.csv *_Odometry.dat *_Groundtruth.dat);;All files (*)"));
    return dialog.ask();
}

Expected<void> openLogAt(const WindowFrame& frame, Overlay& overlay, const QString& path) {
    const PlayedLogRequest request{placeOfLog(path.toStdString()), ""};
    if (frame.actions.unattended()) return overlay.openNow(request);
    overlay.open(request);
    return {};
}

/// The view as the extension says.
Expected<void> savePicture(const WindowFrame& frame, FieldView& field, const QString& path) {
    return writePicture({field.size(), field.logicalDpiX(), frame.window.windowTitle(),
                         [&field](QPainter& painter) { field.paint(painter, field.size()); }},
                        path);
}

/// Scripts wait until it is open, people need not.
Expected<void> openPath(const WindowFrame& frame, WindowFiles& files, Overlay& overlay, const QString& path) {
    if (frame.actions.unattended() && looksLikeLog(logOfFile(path.toStdString())))
        return overlay.openNow({placeOfLog(path.toStdString()), ""});
    if (frame.actions.unattended()) return files.openNow({path.toStdString()});
    files.open(path);
    return {};
}

/// Beside Open.
void addOpenLog(const WindowFrame& frame, Overlay& overlay) {
    frame.actions.add(QObject::tr("&File"),
                      {"open_log", QObject::tr("Open a real &log\u2026"), QKeySequence("Ctrl+L"),
                       QObject::tr("Lay a log of real robots over their simulation")},
                      Actions::Asking{[&] { return askForLog(frame); },
                                      [&](const QString& path) { return openLogAt(frame, overlay, path); }});
}

}  // namespace

void addFileActions(const WindowFrame& frame, FieldView& field, WindowFiles& files, Overlay& overlay,
                    WorkProgress& progress) {
    Actions& actions = frame.actions;
    const QString menu = QObject::tr("&File");
    actions.add(menu,
                {"open", QObject::tr("&Open\u2026"), QKeySequence("Ctrl+O"),
                 QObject::tr("Open a scenario, a recording, a log, a network or the results of a batch")},
                Actions::Asking{[&] { return askForFile(frame); },
                                [&](const QString& path) { return openPath(frame, files, overlay, path); }});
    addOpenLog(frame, overlay);
    QMenu* recent = actions.menu(menu)->addMenu(QObject::tr("Open &recent"));
    recent->setToolTipsVisible(true);
    frame.memory.fillRecent(*recent, [&](const QString& file) { files.open(file); });
    actions.add(menu,
                {"reload", QObject::tr("R&eload"), QKeySequence("F5"),
                 QObject::tr("Read the descriptions again, and simulate up to the same tick")},
                [&](bool) { files.reload(QObject::tr("Reloaded")); });
    actions.addSeparator(menu);
    actions.add(menu,
                {"save_recording", QObject::tr("&Save recording\u2026"), QKeySequence("Ctrl+S"),
                 QObject::tr("Save the run and all its branches")},
                Actions::Asking{[&] {
                                    return files.saver().askForName(frame.window, QObject::tr("Save recording"),
                                                                    QObject::tr("Recordings (*.mcap)"), ".mcap");
                                },
                                [&](const QString& path) { return files.saver().saveRecording(path); }});
    actions.add(menu,
                {"record_to", QObject::tr("Re&cord to\u2026"), QKeySequence("Ctrl+Shift+R"),
                 QObject::tr("Write the run to a file while it goes on, with what was before")},
                Actions::Asking{[&] {
                                    return files.saver().askForName(frame.window, QObject::tr("Record to"),
                                                                    QObject::tr("Recordings (*.mcap)"), ".mcap");
                                },
                                [&](const QString& path) -> Expected<void> {
                                    files.saver().record(path);
                                    return {};
                                }});
    QAction* stop = actions.add(menu,
                                {"stop_recording", QObject::tr("S&top recording"), QKeySequence("Ctrl+Shift+E"),
                                 QObject::tr("Close the file that the run is written to")},
                                [&](bool) { files.saver().record({}); });
    stop->setEnabled(false);
    QObject::connect(&files.saver(), &RunSaver::recordingTo, stop,
                     [stop](const QString& path) { stop->setEnabled(!path.isEmpty()); });
    actions.add(menu,
                {"save_scenario", QObject::tr("Sa&ve state as scenario\u2026"), QKeySequence("Ctrl+Shift+S"),
                 QObject::tr("Save a scenario that goes on from the shown tick")},
                Actions::Asking{[&] {
                                    return files.saver().askForName(frame.window, QObject::tr("Save state as scenario"),
                                                                    QObject::tr("Scenarios (*.toml)"), "_state.toml");
                                },
                                [&](const QString& path) { return files.saver().saveScenario(path); }});
    actions.add(menu,
                {"save_image", QObject::tr("Save &picture\u2026"), QKeySequence("Ctrl+P"),
                 QObject::tr("Save the field view as PNG, SVG or PDF")},
                Actions::Asking{[&] {
                                    return files.saver().askForName(frame.window, QObject::tr("Save picture"),
                                                                    QObject::tr("Pictures (*.png *.svg *.pdf)"),
                                                                    ".png");
                                },
                                [&](const QString& path) {
                                    auto saved = savePicture(frame, field, path);
                                    if (saved) frame.say(QObject::tr("Saved %1").arg(path));
                                    return saved;
                                }});
    actions.addSeparator(menu);
    actions.add(menu,
                {"cancel", QObject::tr("C&ancel or dismiss"), QKeySequence(Qt::Key_Escape),
                 QObject::tr("End what takes long; otherwise dismiss the newest message")},
                [&](bool) { progress.cancel(); });
    actions.add(menu, {"quit", QObject::tr("&Quit"), QKeySequence("Ctrl+Q"), QObject::tr("End the program")},
                [&](bool) { frame.window.close(); });
}

}  // namespace mrose::gui
