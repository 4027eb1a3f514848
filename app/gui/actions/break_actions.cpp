#include <QMenu>
#include <algorithm>

#include "actions/window_actions.h"
#include "frame/window_memory.h"
#include "panels/breakpoint_panel.h"
#include "reality/overlay.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "window/main_window.h"

namespace mrose::gui {
namespace {

/// The breakpoint chosen in the list; nothing, and says so: there is none.
std::optional<Breakpoint> chosenBreak(MainWindow& window) {
    auto chosen = window.breakpointPanel().current();
    if (!chosen) window.say(QObject::tr("Choose a breakpoint in the list first"));
    return chosen;
}

Expected<void> addText(MainWindow& window, const QString& text) {
    window.showDock("breakpoints");
    return window.breakpointPanel().add(text);
}

/// A word, and the name of the body that is selected, where it is one that counts for that.
void addEvent(MainWindow& window, const QString& word, bool robotsOnly) {
    QString text = word;
    const Shown* const shown = window.shown();
    const std::optional<std::size_t> body = window.field().selected();
    if (shown != nullptr && body && *body < shown->frame->scene().bodyCount() &&
        (!robotsOnly || *body < shown->frame->state.robots.size()))
        text += ' ' + qtText(shown->frame->nameOf(*body));
    if (const auto added = addText(window, text); !added) window.say(qtText(added.error().message()));
}

void addWays(MainWindow& window, const QString& menu) {
    Actions& actions = window.actions();
    actions.add(menu,
                {"break_forward", QObject::tr("&Run to the next break"), QKeySequence("F6"),
                 QObject::tr("As fast as possible to where a breakpoint stops next, in the log's next rollouts, too")},
                [&](bool) { window.overlay().shown().goToBreak({}); });
    actions.add(menu,
                {"break_back", QObject::tr("&Back to the last break"), QKeySequence("Shift+F6"),
                 QObject::tr("To where a breakpoint was met last before now, in the log's earlier rollouts, too")},
                [&](bool) { window.overlay().shown().goToBreak({true}); });
    actions.add(menu,
                {"break_last", QObject::tr("When did it last &hold?"), QKeySequence("F7"),
                 QObject::tr("To where the breakpoint chosen in the list was met last before now")},
                Actions::Asking{[&] {
                                    if (const auto chosen = chosenBreak(window))
                                        window.overlay().shown().goToBreak({true, chosen->text});
                                    return QString();
                                },
                                [&](const QString& text) -> Expected<void> {
                                    if (const Shown* const shown = window.shown(); shown != nullptr)
                                        if (auto fits = checkBreakText(text.toStdString(), *shown->setup,
                                                                       shown->frame->reality);
                                            !fits)
                                            return fail("", wrongWith(fits.error()));
                                    window.overlay().shown().goToBreak({true, text.toStdString()});
                                    return {};
                                }});
}

void addKinds(MainWindow& window, const QString& menu) {
    Actions& actions = window.actions();
    auto* offers = new QMenu(&window);
    offers->setToolTipsVisible(true);
    window.breakpointPanel().setOffers(offers);
    actions.add(menu,
                {"add_break", QObject::tr("&Add a condition\u2026"), QKeySequence("F8"),
                 QObject::tr("Stop where a condition holds, such as robot[2].speed > 0.5")},
                Actions::Asking{[&] {
                                    window.showDock("breakpoints");
                                    window.breakpointPanel().edit();
                                    return QString();
                                },
                                [&](const QString& text) { return addText(window, text); }});
    const auto kind = [&](const Actions::Text& text, const QString& word, bool robotsOnly) {
        offers->addAction(
            actions.add(menu, text, [&window, word, robotsOnly](bool) { addEvent(window, word, robotsOnly); }));
    };
    kind({"break_on_contact", QObject::tr("On &contact"), QKeySequence("Shift+C"),
          QObject::tr("Stop where two bodies begin to touch; where one is selected, this one and another")},
         "contact", false);
    kind({"break_on_kick", QObject::tr("On a &kick"), QKeySequence("Shift+K"),
          QObject::tr("Stop at a kick; where a robot is selected, at one of this robot")},
         "kick", true);
    kind({"break_on_goal", QObject::tr("On a &goal"), QKeySequence("Shift+G"),
          QObject::tr("Stop where a ball arrives in a goal")},
         "goal", true);
    const auto plain = [&](const Actions::Text& text, const QString& word) {
        QAction* action = actions.add(menu, text, [&window, word](bool) {
            if (const auto added = addText(window, word); !added) window.say(qtText(added.error().message()));
        });
        offers->addAction(action);
        return action;
    };
    plain({"break_on_fault", QObject::tr("On a &fault"), QKeySequence("Shift+F"),
           QObject::tr("Stop where a controller fails")},
          "fault");
    plain({"break_on_call", QObject::tr("&On breakHere()"), QKeySequence("Shift+B"),
           QObject::tr("Stop where a controller calls breakHere()")},
          "breakHere()");
    QAction* divergence =
        plain({"break_on_divergence", QObject::tr("On &divergence"), QKeySequence("Shift+D"), ""}, "divergence");
    const auto update = [divergence](bool laidOver) {
        divergence->setEnabled(laidOver);
        divergence->setToolTip(laidOver ? QObject::tr("Stop where the run leaves the real log (Shift+D)")
                                        : QObject::tr("Lay a real log over the run first: then it stops where the run "
                                                      "leaves the log (Shift+D)"));
        divergence->setStatusTip(divergence->toolTip());
    };
    update(false);
    QObject::connect(&window.session(), &Session::shown, divergence,
                     [&window, update] { update(window.shown()->canDiverge); });
}

void addChosen(MainWindow& window, const QString& menu) {
    Actions& actions = window.actions();
    Session& session = window.session();
    BreakpointPanel& panel = window.breakpointPanel();
    panel.offer(&actions["break_last"]);
    panel.offer(actions.add(menu,
                            {"toggle_break", QObject::tr("S&witch it on or off"), QKeySequence("F9"),
                             QObject::tr("The breakpoint chosen in the list stops the run, or no longer")},
                            [&](bool) {
                                auto chosen = chosenBreak(window);
                                if (!chosen) return;
                                chosen->enabled = !chosen->enabled;
                                session.changeBreakpoints([=](Breakpoints& all) { all.change(*chosen); });
                            }));
    panel.offer(actions.add(menu,
                            {"break_once", QObject::tr("Stop onl&y once"), QKeySequence("Ctrl+F9"),
                             QObject::tr("The chosen breakpoint is switched off once it has stopped, or no longer")},
                            [&](bool) {
                                auto chosen = chosenBreak(window);
                                if (!chosen) return;
                                chosen->oneShot = !chosen->oneShot;
                                session.changeBreakpoints([=](Breakpoints& all) { all.change(*chosen); });
                            }));
    panel.offer(actions.add(
        menu,
        {"break_from", QObject::tr("Stop from the &n-th time on\u2026"), QKeySequence("Ctrl+F8"),
         QObject::tr("The chosen breakpoint lets so many times pass: in the run, or in all rollouts of a log "
                     "that were played or searched")},
        Actions::Asking{
            [&] {
                const auto chosen = chosenBreak(window);
                return !chosen ? QString()
                               : window.askText(QObject::tr("Breakpoint"), QObject::tr("Stop from this time on:"),
                                                QString::number(chosen->from));
            },
            [&](const QString& text) -> Expected<void> {
                bool number = false;
                const int from = text.trimmed().toInt(&number);
                if (!number || from < 1)
                    return fail("", '"' + text.toStdString() + "\" is no count; expected a whole number from 1");
                auto chosen = chosenBreak(window);
                if (!chosen) return fail("", "no breakpoint is chosen");
                chosen->from = from;
                session.changeBreakpoints([=](Breakpoints& all) { all.change(*chosen); });
                return {};
            }}));
    panel.offer(actions.add(menu,
                            {"delete_break", QObject::tr("De&lete it"), QKeySequence("Shift+F8"),
                             QObject::tr("The breakpoint chosen in the list (there Delete does it, too)")},
                            [&](bool) {
                                if (const auto chosen = chosenBreak(window))
                                    session.changeBreakpoints([=](Breakpoints& all) { all.remove(chosen->id); });
                            }));
    actions.addSeparator(menu);
    actions.add(menu,
                {"toggle_all_breaks", QObject::tr("Sw&itch all on or off"), QKeySequence("Shift+F9"),
                 QObject::tr("All breakpoints off; where all are, on")},
                [&](bool) {
                    if (window.shown() == nullptr) return;
                    const auto& states = window.shown()->breakpoints;
                    const bool off = std::none_of(states.begin(), states.end(), [](const BreakpointState& state) {
                        return state.breakpoint.enabled;
                    });
                    session.changeBreakpoints([off](Breakpoints& all) { all.enableAll(off); });
                });
}

}  // namespace

void addBreakActions(MainWindow& window) {
    const QString menu = QObject::tr("B&reak");
    addWays(window, menu);
    window.actions().addSeparator(menu);
    addKinds(window, menu);
    window.actions().addSeparator(menu);
    addChosen(window, menu);
    Session& session = window.session();
    BreakpointPanel& panel = window.breakpointPanel();
    QObject::connect(&panel, &BreakpointPanel::added, &session, [&session](const Breakpoint& added) {
        session.changeBreakpoints([added](Breakpoints& all) { all.add(added); });
    });
    QObject::connect(&panel, &BreakpointPanel::changed, &session, [&session](const Breakpoint& changed) {
        session.changeBreakpoints([changed](Breakpoints& all) { all.change(changed); });
    });
    QObject::connect(&panel, &BreakpointPanel::removed, &session, [&session](std::uint32_t id) {
        session.changeBreakpoints([id](Breakpoints& all) { all.remove(id); });
    });
    QObject::connect(&window.session(), &Session::shown, &panel, [&window, &panel] {
        panel.setShown(*window.shown());
        window.memory().keepBreakpoints(*window.shown());
    });
}

}  // namespace mrose::gui
