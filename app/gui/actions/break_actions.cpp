#include <QMenu>
#include <algorithm>

#include "actions/window_actions.h"
#include "frame/actions.h"
#include "frame/window_memory.h"
#include "panels/breakpoint_panel.h"
#include "reality/overlay.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// The breakpoint chosen in the list; nothing, and says so: there is none.
std::optional<Breakpoint> chosenBreak(const WindowFrame& frame, const BreakpointPanel& panel) {
    auto chosen = panel.current();
    if (!chosen) frame.say(QObject::tr("Choose a breakpoint in the list first"));
    return chosen;
}

Expected<void> addText(const WindowFrame& frame, BreakpointPanel& panel, const QString& text) {
    frame.showDock("breakpoints");
    return panel.add(text);
}

/// A word, and the name of the body that is selected, where it is one that counts for that.
void addEvent(const WindowFrame& frame, const FieldView& field, BreakpointPanel& panel, const QString& word,
              bool robotsOnly) {
    QString text = word;
    const Shown* const shown = frame.shown();
    const std::optional<std::size_t> body = field.selected();
    if (shown != nullptr && body && *body < shown->frame->scene().bodyCount() &&
        (!robotsOnly || *body < shown->frame->state.robots.size()))
        text += ' ' + qtText(shown->frame->nameOf(*body));
    if (const auto added = addText(frame, panel, text); !added) frame.say(qtText(added.error().message()));
}

void addWays(const WindowFrame& frame, const BreakpointPanel& panel, Overlay& overlay, const QString& menu) {
    Actions& actions = frame.actions;
    actions.add(menu,
                {"break_forward", QObject::tr("&Run to the next break"), QKeySequence("F6"),
                 QObject::tr("As fast as possible to where a breakpoint stops next, in the log's next rollouts, too")},
                [&](bool) { overlay.shown().goToBreak({}); });
    actions.add(menu,
                {"break_back", QObject::tr("&Back to the last break"), QKeySequence("Shift+F6"),
                 QObject::tr("To where a breakpoint was met last before now, in the log's earlier rollouts, too")},
                [&](bool) { overlay.shown().goToBreak({true}); });
    actions.add(menu,
                {"break_last", QObject::tr("When did it last &hold?"), QKeySequence("F7"),
                 QObject::tr("To where the breakpoint chosen in the list was met last before now")},
                Actions::Asking{[&] {
                                    if (const auto chosen = chosenBreak(frame, panel))
                                        overlay.shown().goToBreak({true, chosen->text});
                                    return QString();
                                },
                                [&](const QString& text) -> Expected<void> {
                                    if (const Shown* const shown = frame.shown(); shown != nullptr)
                                        if (auto fits = checkBreakText(text.toStdString(), *shown->setup,
                                                                       shown->frame->reality);
                                            !fits)
                                            return fail("", wrongWith(fits.error()));
                                    overlay.shown().goToBreak({true, text.toStdString()});
                                    return {};
                                }});
}

void addKinds(const WindowFrame& frame, const FieldView& field, BreakpointPanel& panel, const QString& menu) {
    Actions& actions = frame.actions;
    auto* offers = new QMenu(&frame.window);
    offers->setToolTipsVisible(true);
    panel.setOffers(offers);
    actions.add(menu,
                {"add_break", QObject::tr("&Add a condition\u2026"), QKeySequence("F8"),
                 QObject::tr("Stop where a condition holds, such as robot[2].speed > 0.5")},
                Actions::Asking{[&] {
                                    frame.showDock("breakpoints");
                                    panel.edit();
                                    return QString();
                                },
                                [&](const QString& text) { return addText(frame, panel, text); }});
    const auto kind = [&](const Actions::Text& text, const QString& word, bool robotsOnly) {
        offers->addAction(
            actions.add(menu, text, [&, word, robotsOnly](bool) { addEvent(frame, field, panel, word, robotsOnly); }));
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
        QAction* action = actions.add(menu, text, [&, word](bool) {
            if (const auto added = addText(frame, panel, word); !added) frame.say(qtText(added.error().message()));
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
        divergence->setToolTip(laidOver ? QObject::tr("Stop where the run leaves the log (Shift+D)")
                                        : QObject::tr("Lay a log over the run first: then it stops where the run "
                                                      "leaves the log (Shift+D)"));
        divergence->setStatusTip(divergence->toolTip());
    };
    update(false);
    QObject::connect(&frame.session, &Session::shown, divergence,
                     [&frame, update] { update(frame.shown()->canDiverge); });
}

void addChosen(const WindowFrame& frame, BreakpointPanel& panel, const QString& menu) {
    Actions& actions = frame.actions;
    Session& session = frame.session;
    panel.offer(&actions["break_last"]);
    panel.offer(actions.add(menu,
                            {"toggle_break", QObject::tr("S&witch it on or off"), QKeySequence("F9"),
                             QObject::tr("The breakpoint chosen in the list stops the run, or no longer")},
                            [&](bool) {
                                auto chosen = chosenBreak(frame, panel);
                                if (!chosen) return;
                                chosen->enabled = !chosen->enabled;
                                session.changeBreakpoints([=](Breakpoints& all) { all.change(*chosen); });
                            }));
    panel.offer(actions.add(menu,
                            {"break_once", QObject::tr("Stop onl&y once"), QKeySequence("Ctrl+F9"),
                             QObject::tr("The chosen breakpoint is switched off once it has stopped, or no longer")},
                            [&](bool) {
                                auto chosen = chosenBreak(frame, panel);
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
                const auto chosen = chosenBreak(frame, panel);
                return !chosen ? QString()
                               : frame.askText(QObject::tr("Breakpoint"), QObject::tr("Stop from this time on:"),
                                               QString::number(chosen->from));
            },
            [&](const QString& text) -> Expected<void> {
                bool number = false;
                const int from = text.trimmed().toInt(&number);
                if (!number || from < 1)
                    return fail("", '"' + text.toStdString() + "\" is no count; expected a whole number from 1");
                auto chosen = chosenBreak(frame, panel);
                if (!chosen) return fail("", "no breakpoint is chosen");
                chosen->from = from;
                session.changeBreakpoints([=](Breakpoints& all) { all.change(*chosen); });
                return {};
            }}));
    panel.offer(actions.add(menu,
                            {"delete_break", QObject::tr("De&lete it"), QKeySequence("Shift+F8"),
                             QObject::tr("The breakpoint chosen in the list (there Delete does it, too)")},
                            [&](bool) {
                                if (const auto chosen = chosenBreak(frame, panel))
                                    session.changeBreakpoints([=](Breakpoints& all) { all.remove(chosen->id); });
                            }));
    actions.addSeparator(menu);
    actions.add(menu,
                {"toggle_all_breaks", QObject::tr("Sw&itch all on or off"), QKeySequence("Shift+F9"),
                 QObject::tr("All breakpoints off; where all are, on")},
                [&](bool) {
                    if (frame.shown() == nullptr) return;
                    const auto& states = frame.shown()->breakpoints;
                    const bool off = std::none_of(states.begin(), states.end(), [](const BreakpointState& state) {
                        return state.breakpoint.enabled;
                    });
                    session.changeBreakpoints([off](Breakpoints& all) { all.enableAll(off); });
                });
}

}  // namespace

void addBreakActions(const WindowFrame& frame, const FieldView& field, BreakpointPanel& panel, Overlay& overlay) {
    const QString menu = QObject::tr("B&reak");
    addWays(frame, panel, overlay, menu);
    frame.actions.addSeparator(menu);
    addKinds(frame, field, panel, menu);
    frame.actions.addSeparator(menu);
    addChosen(frame, panel, menu);
    Session& session = frame.session;
    QObject::connect(&panel, &BreakpointPanel::added, &session, [&session](const Breakpoint& added) {
        session.changeBreakpoints([added](Breakpoints& all) { all.add(added); });
    });
    QObject::connect(&panel, &BreakpointPanel::changed, &session, [&session](const Breakpoint& changed) {
        session.changeBreakpoints([changed](Breakpoints& all) { all.change(changed); });
    });
    QObject::connect(&panel, &BreakpointPanel::removed, &session, [&session](std::uint32_t id) {
        session.changeBreakpoints([id](Breakpoints& all) { all.remove(id); });
    });
    QObject::connect(&frame.session, &Session::shown, &panel, [&frame, &panel] {
        panel.setShown(*frame.shown());
        frame.memory.keepBreakpoints(*frame.shown());
    });
}

}  // namespace mrose::gui
