#include "session/play_end.h"

#include <QObject>
#include <algorithm>

namespace mrose::gui {
namespace {

/// A branch that began near the scenario's end plays on for so long.
constexpr Nanoseconds leastOfABranch = 10 * nanosecondsPerSecond;

std::int64_t plannedEnd(const TimeTravel& run) {
    const ScenarioParts& parts = run.setup().scenario->parts();
    return parts.scene.ticksOf(parts.duration);
}

}  // namespace

std::int64_t usualEnd(const TimeTravel& run) {
    const std::int64_t planned = plannedEnd(run);
    if (run.branch() == 0) return planned;
    return std::max(planned, run.branches()[run.branch()].tick + run.setup().scene().ticksOf(leastOfABranch));
}

QString endText(const TimeTravel& run) {
    const Scene& scene = run.setup().scene();
    const double planned = toSeconds(scene.timeOf(plannedEnd(run)));
    if (run.branch() == 0 || run.tick() <= plannedEnd(run))
        return QObject::tr("%1 s are over; it can go on").arg(toSeconds(scene.timeOf(run.tick())), 0, 'g', 6);
    const std::int64_t since = run.tick() - run.branches()[run.branch()].tick;
    return QObject::tr("%1 s of this branch are over, and the %2 s of the scenario; it can go on")
        .arg(toSeconds(since * scene.tickLength), 0, 'g', 6)
        .arg(planned, 0, 'g', 6);
}

}  // namespace mrose::gui
