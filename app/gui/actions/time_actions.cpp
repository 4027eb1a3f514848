#include <algorithm>

#include "actions/window_actions.h"
#include "frame/actions.h"
#include "panels/time_bar.h"
#include "reality/overlay.h"
#include "widgets/field_view.h"
#include "widgets/timeline_bar.h"

namespace mrose::gui {
namespace {

/// Of the selected robot, in ticks.
std::int64_t controlPeriod(const WindowFrame& frame, const FieldView& field) {
    if (!frame.shown()) return 1;
    const Scene& scene = frame.shown()->frame->scene();
    const std::optional<std::size_t> body = field.selected();
    if (body && *body < scene.robots.size()) return scene.periodTicks(*body);
    return scene.robots.empty() ? 1 : scene.periodTicks(0);
}

/// To the next mark of the timeline, to the one before, to those that are no contacts.
void addMarkActions(const WindowFrame& frame, TimelineBar& timeline, const QString& menu) {
    const auto go = [&frame](std::optional<std::int64_t> tick) {
        if (tick)
            frame.session.seek(*tick);
        else
            frame.say(QObject::tr("There is no further mark"));
    };
    Actions& actions = frame.actions;
    actions.add(menu,
                {"previous_mark", QObject::tr("Pre&vious mark"), QKeySequence(","),
                 QObject::tr("To the last contact, kick, goal, fault or stop before now")},
                [&timeline, go](bool) { go(timeline.content().previousMark(true)); });
    actions.add(menu,
                {"next_mark", QObject::tr("Next &mark"), QKeySequence("."),
                 QObject::tr("To the next contact, kick, goal, fault or stop")},
                [&timeline, go](bool) { go(timeline.content().nextMark(true)); });
    actions.add(menu,
                {"previous_event", QObject::tr("Previous mark but contacts"), QKeySequence("Ctrl+,"),
                 QObject::tr("To the last kick, goal, fault or stop before now")},
                [&timeline, go](bool) { go(timeline.content().previousMark(false)); });
    actions.add(menu,
                {"next_event", QObject::tr("Next mark but contacts"), QKeySequence("Ctrl+."),
                 QObject::tr("To the next kick, goal, fault or stop")},
                [&timeline, go](bool) { go(timeline.content().nextMark(false)); });
    actions.add(menu,
                {"timeline_zoom_in", QObject::tr("Zoom timeline in"), QKeySequence("]"),
                 QObject::tr("A shorter part of the run on the timeline, about now")},
                [&timeline](bool) { timeline.zoom(2); });
    actions.add(menu,
                {"timeline_zoom_out", QObject::tr("Zoom timeline out"), QKeySequence("["),
                 QObject::tr("A longer part of the run on the timeline")},
                [&timeline](bool) { timeline.zoom(0.5); });
}

}  // namespace

void addTimeActions(const WindowFrame& frame, const FieldView& field, TimelineBar& timeline, Overlay& overlay,
                    TimeBar& bar) {
    Actions& actions = frame.actions;
    Session& session = frame.session;
    const QString menu = QObject::tr("&Time");
    actions.add(menu, {"play", QObject::tr("&Play"), QKeySequence(Qt::Key_Space), QObject::tr("Play or pause")},
                [&](bool) {
                    if (frame.shown() && frame.shown()->playing)
                        session.pause();
                    else if (!overlay.shown().playsNext())
                        session.play();
                });
    actions.addSeparator(menu);
    actions.add(menu,
                {"tick_back", QObject::tr("One tick &back"), QKeySequence(Qt::Key_Left), QObject::tr("One tick back")},
                [&](bool) { session.stepBy(-1); });
    actions.add(menu,
                {"tick_forward", QObject::tr("One tick &forward"), QKeySequence(Qt::Key_Right),
                 QObject::tr("One tick forward")},
                [&](bool) { session.stepBy(1); });
    actions.add(menu,
                {"period_back", QObject::tr("One control period b&ack"), QKeySequence("Shift+Left"),
                 QObject::tr("One control period of the selected robot back")},
                [&](bool) { session.stepBy(-controlPeriod(frame, field)); });
    actions.add(menu,
                {"period_forward", QObject::tr("One control period f&orward"), QKeySequence("Shift+Right"),
                 QObject::tr("One control period of the selected robot forward")},
                [&](bool) { session.stepBy(controlPeriod(frame, field)); });
    actions.addSeparator(menu);
    actions.add(menu,
                {"to_start", QObject::tr("To the &start"), QKeySequence(Qt::Key_Home),
                 QObject::tr("To where the branch begins, and from there to the run's start")},
                [&](bool) {
                    const Shown* shown = frame.shown();
                    if (shown == nullptr) return;
                    const std::int64_t begin = std::max(shown->first, shown->branches[shown->branch].departed);
                    session.seek(shown->branch == 0 || shown->tick() == begin ? shown->first : begin);
                });
    actions.add(menu,
                {"to_end", QObject::tr("To the &end"), QKeySequence(Qt::Key_End),
                 QObject::tr("To the last tick that has been simulated")},
                [&](bool) {
                    if (frame.shown()) session.seek(frame.shown()->last);
                });
    actions.add(menu,
                {"reset", QObject::tr("&Reset"), QKeySequence("Ctrl+Home"),
                 QObject::tr("The run itself at its start, standing; branches stay")},
                [&](bool) {
                    session.pause();
                    session.show(0, 0);
                });
    actions.addSeparator(menu);
    addMarkActions(frame, timeline, menu);
    actions.addSeparator(menu);
    actions.add(menu, {"slower", QObject::tr("S&lower"), QKeySequence(Qt::Key_Minus), QObject::tr("Play slower")},
                [&](bool) { bar.changeSpeed(-1); });
    actions.add(menu, {"faster", QObject::tr("Fas&ter"), QKeySequence(Qt::Key_Plus), QObject::tr("Play faster")},
                [&](bool) { bar.changeSpeed(1); });
}

}  // namespace mrose::gui
