#include <algorithm>

#include "actions/window_actions.h"
#include "reality/overlay.h"
#include "widgets/field_view.h"
#include "widgets/timeline_bar.h"
#include "window/main_window.h"

namespace mrose::gui {
namespace {

/// Of the selected robot, in ticks.
std::int64_t controlPeriod(const MainWindow& window) {
    if (!window.shown()) return 1;
    const Scene& scene = window.shown()->frame->scene();
    const std::optional<std::size_t> body = window.field().selected();
    if (body && *body < scene.robots.size()) return scene.periodTicks(*body);
    return scene.robots.empty() ? 1 : scene.periodTicks(0);
}

/// To the next mark of the timeline, to the one before, to those that are no contacts.
void addMarkActions(MainWindow& window, const QString& menu) {
    const auto go = [&window](std::optional<std::int64_t> tick) {
        if (tick)
            window.session().seek(*tick);
        else
            window.say(QObject::tr("There is no further mark"));
    };
    Actions& actions = window.actions();
    actions.add(menu,
                {"previous_mark", QObject::tr("Pre&vious mark"), QKeySequence(","),
                 QObject::tr("To the last contact, kick, goal, fault or stop before now")},
                [&window, go](bool) { go(window.timeline().previousMark(true)); });
    actions.add(menu,
                {"next_mark", QObject::tr("Next &mark"), QKeySequence("."),
                 QObject::tr("To the next contact, kick, goal, fault or stop")},
                [&window, go](bool) { go(window.timeline().nextMark(true)); });
    actions.add(menu,
                {"previous_event", QObject::tr("Previous mark but contacts"), QKeySequence("Ctrl+,"),
                 QObject::tr("To the last kick, goal, fault or stop before now")},
                [&window, go](bool) { go(window.timeline().previousMark(false)); });
    actions.add(menu,
                {"next_event", QObject::tr("Next mark but contacts"), QKeySequence("Ctrl+."),
                 QObject::tr("To the next kick, goal, fault or stop")},
                [&window, go](bool) { go(window.timeline().nextMark(false)); });
    actions.add(menu,
                {"timeline_zoom_in", QObject::tr("Zoom timeline in"), QKeySequence("]"),
                 QObject::tr("A shorter part of the run on the timeline, about now")},
                [&window](bool) { window.timeline().zoom(2); });
    actions.add(menu,
                {"timeline_zoom_out", QObject::tr("Zoom timeline out"), QKeySequence("["),
                 QObject::tr("A longer part of the run on the timeline")},
                [&window](bool) { window.timeline().zoom(0.5); });
}

}  // namespace

void addTimeActions(MainWindow& window) {
    Actions& actions = window.actions();
    Session& session = window.session();
    const QString menu = QObject::tr("&Time");
    actions.add(menu, {"play", QObject::tr("&Play"), QKeySequence(Qt::Key_Space), QObject::tr("Play or pause")},
                [&](bool) {
                    if (window.shown() && window.shown()->playing)
                        session.pause();
                    else if (!window.overlay().shown().playsNext())
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
                [&](bool) { session.stepBy(-controlPeriod(window)); });
    actions.add(menu,
                {"period_forward", QObject::tr("One control period f&orward"), QKeySequence("Shift+Right"),
                 QObject::tr("One control period of the selected robot forward")},
                [&](bool) { session.stepBy(controlPeriod(window)); });
    actions.addSeparator(menu);
    actions.add(menu,
                {"to_start", QObject::tr("To the &start"), QKeySequence(Qt::Key_Home),
                 QObject::tr("To where the branch begins, and from there to the run's start")},
                [&](bool) {
                    const Shown* shown = window.shown();
                    if (shown == nullptr) return;
                    const std::int64_t begin = std::max(shown->first, shown->branches[shown->branch].departed);
                    session.seek(shown->branch == 0 || shown->tick() == begin ? shown->first : begin);
                });
    actions.add(menu,
                {"to_end", QObject::tr("To the &end"), QKeySequence(Qt::Key_End),
                 QObject::tr("To the last tick that has been simulated")},
                [&](bool) {
                    if (window.shown()) session.seek(window.shown()->last);
                });
    actions.add(menu,
                {"reset", QObject::tr("&Reset"), QKeySequence("Ctrl+Home"),
                 QObject::tr("The run itself at its start, standing; branches stay")},
                [&](bool) {
                    session.pause();
                    session.show(0, 0);
                });
    actions.addSeparator(menu);
    addMarkActions(window, menu);
    actions.addSeparator(menu);
    actions.add(menu, {"slower", QObject::tr("S&lower"), QKeySequence(Qt::Key_Minus), QObject::tr("Play slower")},
                [&](bool) { window.changeSpeed(-1); });
    actions.add(menu, {"faster", QObject::tr("Fas&ter"), QKeySequence(Qt::Key_Plus), QObject::tr("Play faster")},
                [&](bool) { window.changeSpeed(1); });
}

}  // namespace mrose::gui
