#include <QFileDialog>
#include <QFileInfo>

#include "actions/window_actions.h"
#include "frame/actions.h"
#include "frame/status_line.h"
#include "panels/branch_panel.h"
#include "panels/command_panel.h"
#include "panels/side_view.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "workflow/resources.h"
#include "workflow/swap_model.h"

namespace mrose::gui {
namespace {

/// The shown branch's child that was shown last, or its parent: where `beside` is another one, that.
void showOther(const WindowFrame& frame) {
    const Shown* shown = frame.shown();
    if (shown != nullptr && shown->besideBranch)
        frame.session.show(*shown->besideBranch, shown->tick());
    else
        frame.say(QObject::tr("There is no other branch yet: change something while the run stands"));
}

Expected<void> swapModel(const WindowFrame& frame, const FieldView& field, const QString& file) {
    const Shown* shown = frame.shown();
    const std::optional<std::size_t> selected = field.selected();
    if (shown == nullptr || !selected || *selected >= shown->frame->state.robots.size())
        return fail("", "no robot is selected: select the one that is to move as this network says");
    const std::string path = file.toStdString();
    auto setup = withSwappedModel(*shown->setup, *selected, path);
    if (!setup) return tl::unexpected(setup.error());
    const std::string name = shown->frame->nameOf(*selected) + " moves by " + modelName(path);
    frame.session.branchOff(changeSetup(name, shown->setup, std::move(*setup)));
    return {};
}

/// Where one was swapped in from, otherwise those that ship.
QString folderOfNetworks(const BranchSetup& setup) {
    QString folder = qtText((resourceFolder() / "nets").string());
    for (const Value::File& read : setup.value ? setup.value->files() : std::vector<Value::File>()) {
        const QFileInfo file(qtText(read->name));
        if (file.isAbsolute() && file.suffix() == "net" && file.exists()) folder = file.path();
    }
    return folder;
}

Expected<std::uint64_t> seedFrom(const QString& text) {
    bool number = false;
    const qulonglong seed = text.trimmed().toULongLong(&number);
    if (!number) return fail("", "\"" + text.toStdString() + "\" is no seed; expected a whole number from 0");
    return seed;
}

/// What begins a branch.
void addChanges(const WindowFrame& frame, const FieldView& field, CommandPanel& command, const QString& menu) {
    Actions& actions = frame.actions;
    Session& session = frame.session;
    const auto edit = [&frame, &command] {
        frame.whenStanding(QObject::tr("Stopped, since commands are changed while the run stands"), [&frame, &command] {
            if (const QString missing = command.edit(); !missing.isEmpty()) frame.status.ask(missing);
        });
    };
    actions.add(menu,
                {"cause_of_kick", QObject::tr("Who &kicked, and why"), QKeySequence("K"),
                 QObject::tr("To the decision that led to the last kick")},
                [&](bool) { session.ask(&Debugger::showCauseOfKick); });
    actions.add(menu,
                {"change_command", QObject::tr("&Change its command"), QKeySequence("E"),
                 QObject::tr("Change what the selected robot decided")},
                [edit](bool) { edit(); });
    actions.add(menu,
                {"apply_command", QObject::tr("&Try the changed command"), QKeySequence("Ctrl+Return"),
                 QObject::tr("A branch with the changed command in place of the one decided")},
                [&, edit](bool) {
                    if (frame.shown() && frame.shown()->playing) return edit();
                    if (const QString missing = command.apply(); !missing.isEmpty()) frame.say(missing);
                });
    actions.add(menu,
                {"other_noise", QObject::tr("Other &noise from here"), QKeySequence("Shift+N"),
                 QObject::tr("A branch from this tick on with another seed")},
                [&](bool) {
                    if (!frame.shown()) return;
                    session.branchOff(changeNoise());
                });
    actions.add(menu,
                {"restart_with_seed", QObject::tr("&Restart with another seed\u2026"), QKeySequence("Ctrl+R"),
                 QObject::tr("From the start with another seed, as a branch")},
                Actions::Asking{[&] {
                                    return frame.askText(QObject::tr("Restart"), QObject::tr("Seed:"),
                                                         frame.shown()
                                                             ? QString::number(frame.shown()->frame->state.seed + 1)
                                                             : QString());
                                },
                                [&](const QString& text) -> Expected<void> {
                                    const auto seed = seedFrom(text);
                                    if (!seed) return tl::unexpected(seed.error());
                                    if (const Shown* shown = frame.shown())
                                        session.branchOff(restartWithSeed(shown->setup, *seed));
                                    return {};
                                }});
    actions.add(menu,
                {"swap_model", QObject::tr("Other motion &model\u2026"), QKeySequence("M"),
                 QObject::tr("A branch in which the selected robot moves as another network says")},
                Actions::Asking{
                    [&] {
                        const std::optional<std::size_t> selected = field.selected();
                        if (!selected || !frame.shown() || *selected >= frame.shown()->frame->state.robots.size()) {
                            frame.status.ask(QObject::tr("Select the robot first that is to move otherwise"));
                            return QString();
                        }
                        const QString robot = qtText(frame.shown()->frame->nameOf(*selected));
                        return QFileDialog::getOpenFileName(
                            &frame.window, QObject::tr("Motion network for %1").arg(robot),
                            folderOfNetworks(*frame.shown()->setup), QObject::tr("Networks (*.net);;All files (*)"));
                    },
                    [&](const QString& path) { return swapModel(frame, field, path); }});
}

/// What is done with branches that are there.
void addBranchViews(const WindowFrame& frame, SideView& view, const BranchPanel& branches, const QString& menu) {
    Actions& actions = frame.actions;
    Session& session = frame.session;
    actions.add(menu,
                {"rename_branch", QObject::tr("Ren&ame\u2026"), QKeySequence("F2"),
                 QObject::tr("Another name for the branch that is shown")},
                Actions::Asking{
                    [&] {
                        return frame.askText(
                            QObject::tr("Rename"), QObject::tr("Name of the branch:"),
                            frame.shown() ? qtText(frame.shown()->branches[frame.shown()->branch].name) : QString());
                    },
                    [&](const QString& text) -> Expected<void> {
                        if (text.trimmed().isEmpty()) return fail("", "a branch's name must not be empty");
                        if (!frame.shown()) return {};
                        session.ask([branch = frame.shown()->branch, name = text.trimmed().toStdString()](
                                        Debugger& debugger) { debugger.run().branches().rename(branch, name); });
                        return {};
                    }});
    const auto remove = [&session](std::uint32_t branch) {
        session.ask([=](Debugger& debugger) { debugger.removeBranch(branch); });
    };
    QObject::connect(&branches, &BranchPanel::removalRequested, &session, remove);
    actions.add(menu,
                {"delete_branch", QObject::tr("&Delete"), QKeySequence("Ctrl+Delete"),
                 QObject::tr("The branch chosen in the list, with what departed from it (there Delete does it, too)")},
                [&frame, &branches, remove](bool) {
                    const auto chosen = branches.current();
                    if (chosen && *chosen != 0)
                        remove(*chosen);
                    else
                        frame.say(QObject::tr("Choose a branch in the list first; the run itself cannot be deleted"));
                });
    actions.add(menu,
                {"delete_other_branches", QObject::tr("Delete all ot&hers"), QKeySequence("Ctrl+Shift+Delete"),
                 QObject::tr("All branches but the shown one and those that it came from")},
                [&session](bool) { session.ask(&Debugger::removeOtherBranches); });
    actions.add(menu,
                {"restore_branches", QObject::tr("&Bring back what was deleted"), QKeySequence("Ctrl+Shift+Insert"),
                 QObject::tr("Branches that were deleted, or undone before another change")},
                [&session](bool) { session.ask(&Debugger::restoreBranches); });
    actions.add(menu,
                {"compare_with", QObject::tr("Com&pare with the chosen one"), QKeySequence("Ctrl+B"),
                 QObject::tr("The branch chosen in the list beside the one that is shown")},
                [&](bool) {
                    const auto branch = branches.current();
                    if (branch && frame.shown() && *branch != frame.shown()->branch)
                        session.ask([=](Debugger& debugger) { debugger.run().setBeside(branch); });
                    else
                        frame.say(QObject::tr("Choose another branch in the list first"));
                });
    actions.add(menu,
                {"other_branch", QObject::tr("&Other branch"), QKeySequence("X"),
                 QObject::tr("To the branch that this one is compared with, at the same tick")},
                [&](bool) { showOther(frame); });
    actions.add(menu,
                {"side_by_side", QObject::tr("&Side by side"), QKeySequence("S"),
                 QObject::tr("The branch that this one is compared with in a field of its own"), true},
                [&](bool on) {
                    const bool possible = frame.shown() && frame.shown()->beside;
                    if (on && !possible) {
                        actions["side_by_side"].setChecked(false);
                        frame.say(QObject::tr("There is no other branch yet: change something while the run stands"));
                    }
                    view.setSideBySide(on && possible);
                    if (frame.shown()) view.setShown(*frame.shown());
                });
}

}  // namespace

void addBranchActions(const WindowFrame& frame, SideView& view, BranchPanel& branches, CommandPanel& command) {
    const QString menu = QObject::tr("&Branch");
    addChanges(frame, view.field(), command, menu);
    frame.actions.addSeparator(menu);
    addBranchViews(frame, view, branches, menu);
    // With nothing to be beside, it is off, and does not wait for the next branch.
    QObject::connect(&frame.session, &Session::shown, &view, [&frame, &view] {
        QAction& action = frame.actions["side_by_side"];
        if (frame.shown()->beside || !action.isChecked()) return;
        action.setChecked(false);
        view.setSideBySide(false);
    });
}

}  // namespace mrose::gui
