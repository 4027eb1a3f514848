#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QTreeWidget>

#include "actions/window_actions.h"
#include "frame/window_memory.h"
#include "panels/log_dialog.h"
#include "reality/overlay.h"
#include "reality/overlay_panel.h"
#include "reality/overlay_strip.h"
#include "reality/robot_dialog.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "window/main_window.h"
#include "workflow/open_model.h"
#include "workflow/resources.h"

namespace mrose::gui {
namespace {

/// A log is a folder or a file: of an MRCLAM folder any of its files will do.
QString askForLog(MainWindow& window) {
    LogDialog dialog(&window, QObject::tr("Open a real log"), window.memory().lastFolder(),
                     QObject::tr("Logs (*.csv *_Odometry.dat *_Groundtruth.dat);;All files (*)"));
    const QString file = dialog.ask();
    return file.endsWith(".dat") ? QFileInfo(file).path() : file;
}

Expected<void> openLogAt(MainWindow& window, const QString& path) {
    const PlayedLogRequest request{placeOfLog(path.toStdString()), ""};
    if (window.actions().unattended()) return window.overlay().openNow(request);
    window.overlay().open(request);
    return {};
}

/// Of a log that does not say it; cancelled, what is open stays.
void askWhatDrove(MainWindow& window, const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked) {
    delete window.findChild<RobotDialog*>();
    const QString log = QFileInfo(qtText(request.log)).absoluteFilePath();
    auto* dialog = new RobotDialog(log, &window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    if (const QString before = window.memory().robotOf(log); !before.isEmpty()) dialog->choose(before);
    QObject::connect(dialog, &RobotDialog::chosen, &window, [&window, request, asked, log](const QString& robotFile) {
        window.memory().keepRobot(log, robotFile);
        PlayedLogRequest answered = request;
        answered.robotFile = robotFile.toStdString();
        window.overlay().open(answered, asked);
    });
    dialog->open();
}

void layModelOfFile(MainWindow& window) {
    const QString file =
        QFileDialog::getOpenFileName(&window, QObject::tr("Motion network"), window.memory().lastFolder(),
                                     QObject::tr("Networks (*.net);;All files (*)"));
    if (!file.isEmpty()) window.overlay().models().add(file.toStdString());
}

/// Those that ship, as a menu over the field; other ones are files.
void offerModels(MainWindow& window) {
    auto* menu = new QMenu(&window);
    menu->setObjectName("models_menu");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    for (const std::string& known : modelNames(*window.overlay().rollouts().log()))
        menu->addAction(qtText(known), &window, [&window, known] { window.overlay().models().add(known); });
    menu->addSeparator();
    menu->addAction(QObject::tr("Other file\u2026"), &window, [&window] { layModelOfFile(window); });
    menu->popup(window.field().mapToGlobal(QPoint(40, 40)));
    menu->setActiveAction(menu->actions().first());
}

/// The one of the list's current line, otherwise the only one beside the scenario's own; empty: there are none, or it
/// is not clear which.
QString modelToRemove(MainWindow& window) {
    const QTreeWidget& list = window.overlayPanel().models();
    const auto& models = window.overlay().models().all();
    const int line = models.size() == 2 ? 1 : list.indexOfTopLevelItem(list.currentItem());
    if (line > 0 && line < list.topLevelItemCount()) return list.topLevelItem(line)->text(0);
    window.say(models.size() < 2
                   ? QObject::tr("No model is laid over")
                   : QObject::tr("Choose one of the models in the list first, but not the scenario's own"));
    return {};
}

Expected<void> removeModel(MainWindow& window, const std::string& name) {
    const auto& models = window.overlay().models().all();
    std::string names;
    for (std::size_t i = 1; i < models.size(); ++i) {
        if (models[i].name == name) return window.overlay().models().remove(i), Expected<void>();
        names += (names.empty() ? "\"" : ", \"") + models[i].name + '"';
    }
    return fail(name, "is not laid over" + (names.empty() ? std::string() : "; expected one of " + names));
}

void goToDivergence(MainWindow& window) {
    Overlay& overlay = window.overlay();
    if (overlay.shown().goToDivergence()) return;
    window.say(!overlay.rollouts().shown() ? QObject::tr("No rollout of the log is shown")
               : overlay.share() < 1 ? QObject::tr("Nothing leaves the real trajectory as far as they are compared")
               : overlay.rollouts().comparison()
                   ? QObject::tr("Nothing leaves the real trajectory by more than the bound in any of the rollouts")
                   : QObject::tr("The rollouts are not compared"));
}

/// The robot of the overlay that a body of the run is.
std::optional<std::size_t> robotOf(MainWindow& window, std::optional<std::size_t> body) {
    if (!body || !window.shown() || !window.overlay().rollouts().log() ||
        *body >= window.shown()->frame->scene().bodyCount())
        return {};
    const std::vector<ComparedRobot>& robots = window.overlay().rollouts().world().robots();
    const std::string name = window.shown()->frame->nameOf(*body);
    for (std::size_t robot = 0; robot < robots.size(); ++robot)
        if (robots[robot].name == name) return robot;
    return {};
}

/// Selection, strip and panel follow the overlay, and it them.
void bindOverlay(MainWindow& window) {
    Overlay& overlay = window.overlay();
    RolloutStrip& strip = window.rolloutStrip();
    strip.setObjectName("courses_strip");
    strip.hide();
    QObject::connect(&overlay, &Overlay::changed, &window, [&window, &overlay, &strip] {
        strip.setVisible(overlay.rollouts().log() != nullptr);
        strip.setContent(stripOf(overlay));
        if (overlay.rollouts().log()) window.showReality();
    });
    QObject::connect(&overlay, &Overlay::robotKindUnknown, &window,
                     [&window](const auto& request, const auto& asked) { askWhatDrove(window, request, asked); });
    QObject::connect(&window.session(), &Session::shown, &strip, [&window, &strip] {
        const FieldFrame& frame = *window.shown()->frame;
        if (frame.reality) strip.setNow(frame.reality->start + frame.scene().timeOf(frame.state.tick));
    });
    QObject::connect(&strip, &RolloutStrip::rolloutRequested, &overlay,
                     [&overlay](std::size_t rollout) { overlay.shown().show(rollout, overlay.rollouts().robot()); });
    QObject::connect(&window.field(), &FieldView::bodySelected, &overlay,
                     [&window, &overlay](auto body) { overlay.shown().setRobot(robotOf(window, body)); });
    QObject::connect(&window.overlayPanel(), &OverlayPanel::modelFileWanted, &window,
                     [&window] { layModelOfFile(window); });
    QObject::connect(&window.overlayPanel(), &OverlayPanel::modelRemovalWanted, &window,
                     [&window] { window.actions()["remove_model"].trigger(); });
}

}  // namespace

void addOpenLog(MainWindow& window) {
    window.actions().add(QObject::tr("&File"),
                         {"open_log", QObject::tr("Open a real &log\u2026"), QKeySequence("Ctrl+L"),
                          QObject::tr("Lay a log of real robots over their simulation")},
                         Actions::Asking{[&] { return askForLog(window); },
                                         [&](const QString& path) { return openLogAt(window, path); }});
}

void addOverlayActions(MainWindow& window) {
    Actions& actions = window.actions();
    const QString menu = QObject::tr("&Reality");
    actions.menu(menu)->addAction(&actions["open_log"]);
    actions.addSeparator(menu);
    const auto whileOpen = [&](QAction* action) {
        action->setEnabled(false);
        QObject::connect(&window.overlay(), &Overlay::changed, action,
                         [&window, action] { action->setEnabled(window.overlay().rollouts().log() != nullptr); });
    };
    whileOpen(actions.add(menu,
                          {"next_course", QObject::tr("&Next rollout"), QKeySequence("Ctrl+PgDown"),
                           QObject::tr("The rollout after the shown one")},
                          [&](bool) { window.overlay().shown().showNext(1); }));
    whileOpen(actions.add(menu,
                          {"previous_course", QObject::tr("&Previous rollout"), QKeySequence("Ctrl+PgUp"),
                           QObject::tr("The rollout before the shown one")},
                          [&](bool) { window.overlay().shown().showNext(-1); }));
    whileOpen(actions.add(menu,
                          {"go_to_divergence", QObject::tr("&Where it diverges"), QKeySequence("D"),
                           QObject::tr("To the first divergence of the shown rollout, or of the next that has one")},
                          [&](bool) { goToDivergence(window); }));
    actions.addSeparator(menu);
    whileOpen(actions.add(menu,
                          {"add_model", QObject::tr("Lay another &model over\u2026"), QKeySequence("Ctrl+M"),
                           QObject::tr("Show what another motion model makes of the same commands")},
                          Actions::Asking{[&] {
                                              offerModels(window);
                                              return QString();
                                          },
                                          [&](const QString& model) -> Expected<void> {
                                              window.overlay().models().add(model.toStdString());
                                              return {};
                                          }}));
    whileOpen(
        actions.add(menu,
                    {"remove_model", QObject::tr("&Remove a model"), QKeySequence("Ctrl+Alt+M"),
                     QObject::tr("Lay this model over no longer: the one that is chosen in the list (Delete)")},
                    Actions::Asking{[&] { return modelToRemove(window); },
                                    [&](const QString& model) { return removeModel(window, model.toStdString()); }}));
    whileOpen(actions.add(
        menu,
        {"close_log", QObject::tr("&Close the log"), QKeySequence("Ctrl+Shift+W"), QObject::tr("Go on without it")},
        [&](bool) { window.overlay().close(); }));
    bindOverlay(window);
}

}  // namespace mrose::gui
