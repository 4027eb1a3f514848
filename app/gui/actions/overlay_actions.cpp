#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QTreeWidget>

#include "actions/window_actions.h"
#include "frame/actions.h"
#include "frame/window_memory.h"
#include "panels/log_dialog.h"
#include "reality/overlay.h"
#include "reality/overlay_panel.h"
#include "reality/overlay_strip.h"
#include "reality/robot_dialog.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "workflow/open_model.h"
#include "workflow/resources.h"

namespace mrose::gui {
namespace {

/// Of a log that does not say it; cancelled, what is open stays.
void askWhatDrove(const WindowFrame& frame, Overlay& overlay, const PlayedLogRequest& request,
                  const std::optional<RolloutPlan>& asked) {
    delete frame.window.findChild<RobotDialog*>();
    const QString log = QFileInfo(qtText(request.log)).absoluteFilePath();
    auto* dialog = new RobotDialog(log, &frame.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    if (const QString before = frame.memory.robotOf(log); !before.isEmpty()) dialog->choose(before);
    QObject::connect(dialog, &RobotDialog::chosen, &overlay,
                     [&frame, &overlay, request, asked, log](const QString& robotFile) {
                         frame.memory.keepRobot(log, robotFile);
                         PlayedLogRequest answered = request;
                         answered.robotFile = robotFile.toStdString();
                         overlay.open(answered, asked);
                     });
    dialog->open();
}

void layModelOfFile(const WindowFrame& frame, Overlay& overlay) {
    const QString file =
        QFileDialog::getOpenFileName(&frame.window, QObject::tr("Motion network"), frame.memory.lastFolder(),
                                     QObject::tr("Networks (*.net);;All files (*)"));
    if (!file.isEmpty()) overlay.models().add(file.toStdString());
}

/// Those that ship, as a menu over the field; other ones are files.
void offerModels(const WindowFrame& frame, const FieldView& field, Overlay& overlay) {
    auto* menu = new QMenu(&frame.window);
    menu->setObjectName("models_menu");
    menu->setAttribute(Qt::WA_DeleteOnClose);
    for (const std::string& known : modelNames(*overlay.rollouts().log()))
        menu->addAction(qtText(known), &overlay, [&overlay, known] { overlay.models().add(known); });
    menu->addSeparator();
    menu->addAction(QObject::tr("Other file\u2026"), &overlay, [&] { layModelOfFile(frame, overlay); });
    menu->popup(field.mapToGlobal(QPoint(40, 40)));
    menu->setActiveAction(menu->actions().first());
}

/// The one of the list's current line, otherwise the only one beside the scenario's own; empty: there are none, or it
/// is not clear which.
QString modelToRemove(const WindowFrame& frame, const Overlay& overlay, const OverlayPanel& panel) {
    const QTreeWidget& list = panel.models();
    const auto& models = overlay.models().all();
    const int line = models.size() == 2 ? 1 : list.indexOfTopLevelItem(list.currentItem());
    if (line > 0 && line < list.topLevelItemCount()) return qtText(models[static_cast<std::size_t>(line)].name);
    frame.say(models.size() < 2
                  ? QObject::tr("No model is laid over")
                  : QObject::tr("Choose one of the models in the list first, but not the scenario's own"));
    return {};
}

Expected<void> removeModel(Overlay& overlay, const std::string& name) {
    const auto& models = overlay.models().all();
    std::string names;
    for (std::size_t i = 1; i < models.size(); ++i) {
        if (models[i].name == name) return overlay.models().remove(i), Expected<void>();
        names += (names.empty() ? "\"" : ", \"") + models[i].name + '"';
    }
    return fail(name, "is not laid over" + (names.empty() ? std::string() : "; expected one of " + names));
}

void goToDivergence(const WindowFrame& frame, Overlay& overlay) {
    if (overlay.shown().goToDivergence()) return;
    if (!overlay.rollouts().shown()) return frame.say(QObject::tr("No rollout of the log is shown"));
    const char* const real = overlay.rollouts().world().log().real();
    frame.say(
        overlay.comparing().share() < 1
            ? QObject::tr("Nothing leaves the %1 trajectory as far as they are compared").arg(real)
        : overlay.rollouts().comparison()
            ? QObject::tr("Nothing leaves the %1 trajectory by more than the bound in any of the rollouts").arg(real)
            : QObject::tr("The rollouts are not compared"));
}

/// The robot of the overlay that a body of the run is.
std::optional<std::size_t> robotOf(const WindowFrame& frame, const Overlay& overlay, std::optional<std::size_t> body) {
    if (!body || !frame.shown() || !overlay.rollouts().log() || *body >= frame.shown()->frame->scene().bodyCount())
        return {};
    const std::vector<ComparedRobot>& robots = overlay.rollouts().world().robots();
    const std::string name = frame.shown()->frame->nameOf(*body);
    for (std::size_t robot = 0; robot < robots.size(); ++robot)
        if (robots[robot].name == name) return robot;
    return {};
}

/// Selection, strip and panel follow the overlay, and it them.
void bindOverlay(const WindowFrame& frame, FieldView& field, Overlay& overlay, OverlayPanel& panel,
                 RolloutStrip& strip) {
    strip.setObjectName("courses_strip");
    strip.hide();
    QObject::connect(&overlay, &Overlay::changed, &strip, [&overlay, &strip] {
        strip.setVisible(overlay.rollouts().log() != nullptr);
        strip.setContent(stripOf(overlay));
    });
    QObject::connect(&overlay, &Overlay::robotKindUnknown, &overlay,
                     [&](const auto& request, const auto& asked) { askWhatDrove(frame, overlay, request, asked); });
    QObject::connect(&frame.session, &Session::shown, &strip, [&frame, &strip] {
        const FieldFrame& now = *frame.shown()->frame;
        if (now.reality) strip.setNow(now.reality->start + now.scene().timeOf(now.state.tick));
    });
    QObject::connect(&strip, &RolloutStrip::rolloutRequested, &overlay,
                     [&overlay](std::size_t rollout) { overlay.shown().show(rollout, overlay.rollouts().robot()); });
    QObject::connect(&field, &FieldView::bodySelected, &overlay,
                     [&](auto body) { overlay.shown().setRobot(robotOf(frame, overlay, body)); });
    QObject::connect(&panel, &OverlayPanel::modelFileWanted, &overlay, [&] { layModelOfFile(frame, overlay); });
    QObject::connect(&panel, &OverlayPanel::modelRemovalWanted, &overlay,
                     [&frame] { frame.actions["remove_model"].trigger(); });
}

}  // namespace

void addOverlayActions(const WindowFrame& frame, FieldView& field, Overlay& overlay, OverlayPanel& panel,
                       RolloutStrip& strip) {
    Actions& actions = frame.actions;
    const QString menu = QObject::tr("&Reality");
    actions.menu(menu)->addAction(&actions["open_log"]);
    actions.addSeparator(menu);
    const auto whileOpen = [&](QAction* action) {
        action->setEnabled(false);
        QObject::connect(&overlay, &Overlay::changed, action,
                         [&overlay, action] { action->setEnabled(overlay.rollouts().log() != nullptr); });
    };
    whileOpen(actions.add(menu,
                          {"next_course", QObject::tr("&Next rollout"), QKeySequence("Ctrl+PgDown"),
                           QObject::tr("The rollout after the shown one")},
                          [&](bool) { overlay.shown().showNext(1); }));
    whileOpen(actions.add(menu,
                          {"previous_course", QObject::tr("&Previous rollout"), QKeySequence("Ctrl+PgUp"),
                           QObject::tr("The rollout before the shown one")},
                          [&](bool) { overlay.shown().showNext(-1); }));
    whileOpen(actions.add(menu,
                          {"go_to_divergence", QObject::tr("&Where it diverges"), QKeySequence("D"),
                           QObject::tr("To the first divergence of the shown rollout, or of the next that has one")},
                          [&](bool) { goToDivergence(frame, overlay); }));
    actions.addSeparator(menu);
    whileOpen(actions.add(menu,
                          {"add_model", QObject::tr("Lay another &model over\u2026"), QKeySequence("Ctrl+M"),
                           QObject::tr("Show what another motion model makes of the same commands")},
                          Actions::Asking{[&] {
                                              offerModels(frame, field, overlay);
                                              return QString();
                                          },
                                          [&](const QString& model) -> Expected<void> {
                                              overlay.models().add(model.toStdString());
                                              return {};
                                          }}));
    whileOpen(
        actions.add(menu,
                    {"remove_model", QObject::tr("&Remove a model"), QKeySequence("Ctrl+Alt+M"),
                     QObject::tr("Lay this model over no longer: the one that is chosen in the list (Delete)")},
                    Actions::Asking{[&] { return modelToRemove(frame, overlay, panel); },
                                    [&](const QString& model) { return removeModel(overlay, model.toStdString()); }}));
    whileOpen(actions.add(
        menu,
        {"close_log", QObject::tr("&Close the log"), QKeySequence("Ctrl+Shift+W"), QObject::tr("Go on without it")},
        [&](bool) { overlay.close(); }));
    bindOverlay(frame, field, overlay, panel, strip);
}

}  // namespace mrose::gui
