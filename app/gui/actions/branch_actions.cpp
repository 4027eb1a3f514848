#include <QFileDialog>
#include <QFileInfo>

#include "actions/window_actions.h"
#include "panels/branch_panel.h"
#include "panels/command_panel.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "window/main_window.h"
#include "workflow/resources.h"
#include "workflow/swap_model.h"

namespace mrose::gui {
namespace {

/// The shown branch's child that was shown last, or its parent: where `beside` is another one, that.
void showOther(MainWindow& window) {
    const Shown* shown = window.shown();
    if (shown != nullptr && shown->besideBranch)
        window.session().show(*shown->besideBranch, shown->tick());
    else
        window.say(QObject::tr("There is no other branch yet: change something while the run stands"));
}

Expected<void> swapModel(MainWindow& window, const QString& file) {
    const Shown* shown = window.shown();
    const std::optional<std::size_t> selected = window.field().selected();
    if (shown == nullptr || !selected || *selected >= shown->frame->state.robots.size())
        return fail("", "no robot is selected: select the one that is to move as this network says");
    const std::string path = file.toStdString();
    auto setup = withSwappedModel(*shown->setup, *selected, path);
    if (!setup) return tl::unexpected(setup.error());
    const std::string name = shown->frame->nameOf(*selected) + " moves by " + modelName(path);
    window.session().branchOff(changeSetup(name, shown->setup, std::move(*setup)));
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
void addChanges(MainWindow& window, const QString& menu) {
    Actions& actions = window.actions();
    Session& session = window.session();
    actions.add(menu,
                {"cause_of_kick", QObject::tr("Who &kicked, and why"), QKeySequence("K"),
                 QObject::tr("To the decision that led to the last kick")},
                [&](bool) { session.ask(&Debugger::showCauseOfKick); });
    actions.add(menu,
                {"change_command", QObject::tr("&Change its command"), QKeySequence("E"),
                 QObject::tr("Change what the selected robot decided")},
                [&](bool) {
                    if (const QString missing = window.commandPanel().edit(); !missing.isEmpty()) window.say(missing);
                });
    actions.add(menu,
                {"apply_command", QObject::tr("&Try the changed command"), QKeySequence("Ctrl+Return"),
                 QObject::tr("A branch with the changed command in place of the one decided")},
                [&](bool) { window.commandPanel().apply(); });
    actions.add(menu,
                {"other_noise", QObject::tr("Other &noise from here"), QKeySequence("Shift+N"),
                 QObject::tr("A branch from this tick on with another seed")},
                [&](bool) {
                    if (!window.shown()) return;
                    session.branchOff(changeNoise());
                });
    actions.add(menu,
                {"restart_with_seed", QObject::tr("&Restart with another seed\u2026"), QKeySequence("Ctrl+R"),
                 QObject::tr("From the start with another seed, as a branch")},
                Actions::Asking{[&] {
                                    return window.askText(QObject::tr("Restart"), QObject::tr("Seed:"),
                                                          window.shown()
                                                              ? QString::number(window.shown()->frame->state.seed + 1)
                                                              : QString());
                                },
                                [&](const QString& text) -> Expected<void> {
                                    const auto seed = seedFrom(text);
                                    if (!seed) return tl::unexpected(seed.error());
                                    if (const Shown* shown = window.shown())
                                        session.branchOff(restartWithSeed(shown->setup, *seed));
                                    return {};
                                }});
    actions.add(menu,
                {"swap_model", QObject::tr("Other motion &model\u2026"), QKeySequence("M"),
                 QObject::tr("A branch in which the selected robot moves as another network says")},
                Actions::Asking{
                    [&] {
                        const std::optional<std::size_t> selected = window.field().selected();
                        if (!selected || !window.shown() || *selected >= window.shown()->frame->state.robots.size()) {
                            window.say(QObject::tr("Select the robot first that is to move otherwise"));
                            return QString();
                        }
                        const QString robot = qtText(window.shown()->frame->nameOf(*selected));
                        return QFileDialog::getOpenFileName(&window, QObject::tr("Motion network for %1").arg(robot),
                                                            folderOfNetworks(*window.shown()->setup),
                                                            QObject::tr("Networks (*.net);;All files (*)"));
                    },
                    [&](const QString& path) { return swapModel(window, path); }});
}

/// What is done with branches that are there.
void addBranchViews(MainWindow& window, const QString& menu) {
    Actions& actions = window.actions();
    Session& session = window.session();
    actions.add(menu,
                {"rename_branch", QObject::tr("Ren&ame\u2026"), QKeySequence("F2"),
                 QObject::tr("Another name for the branch that is shown")},
                Actions::Asking{[&] {
                                    return window.askText(
                                        QObject::tr("Rename"), QObject::tr("Name of the branch:"),
                                        window.shown() ? qtText(window.shown()->branches[window.shown()->branch].name)
                                                       : QString());
                                },
                                [&](const QString& text) -> Expected<void> {
                                    if (text.trimmed().isEmpty()) return fail("", "a branch's name must not be empty");
                                    if (!window.shown()) return {};
                                    session.ask([branch = window.shown()->branch, name = text.trimmed().toStdString()](
                                                    Debugger& debugger) { debugger.run().rename(branch, name); });
                                    return {};
                                }});
    actions.add(menu,
                {"compare_with", QObject::tr("Com&pare with the chosen one"), QKeySequence("Ctrl+B"),
                 QObject::tr("The branch chosen in the list beside the one that is shown")},
                [&](bool) {
                    const auto branch = window.branchPanel().current();
                    if (branch && window.shown() && *branch != window.shown()->branch)
                        session.ask([=](Debugger& debugger) { debugger.run().setBeside(branch); });
                    else
                        window.say(QObject::tr("Choose another branch in the list first"));
                });
    actions.add(menu,
                {"other_branch", QObject::tr("&Other branch"), QKeySequence("X"),
                 QObject::tr("To the branch that this one is compared with, at the same tick")},
                [&](bool) { showOther(window); });
    actions.add(menu,
                {"side_by_side", QObject::tr("&Side by side"), QKeySequence("S"),
                 QObject::tr("The branch that this one is compared with in a field of its own"), true},
                [&](bool on) {
                    const bool possible = window.shown() && window.shown()->beside;
                    if (on && !possible) {
                        actions["side_by_side"].setChecked(false);
                        window.say(QObject::tr("There is no other branch yet: change something while the run stands"));
                    }
                    window.setSideBySide(on && possible);
                });
}

}  // namespace

void addBranchActions(MainWindow& window) {
    const QString menu = QObject::tr("&Branch");
    addChanges(window, menu);
    window.actions().addSeparator(menu);
    addBranchViews(window, menu);
}

}  // namespace mrose::gui
