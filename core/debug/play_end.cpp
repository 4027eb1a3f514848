#include "debug/play_end.h"

#include <algorithm>

#include "world/seconds_text.h"

namespace mrose {
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

std::string endText(const TimeTravel& run) {
    const Scene& scene = run.setup().scene();
    if (run.branch() == 0 || run.tick() <= plannedEnd(run))
        return secondsText(scene.timeOf(run.tick()), 0) + " s are over; it can go on";
    const std::int64_t since = run.tick() - run.branches()[run.branch()].tick;
    return secondsText(since * scene.tickLength, 0) + " s of this branch are over, and the " +
           secondsText(scene.timeOf(plannedEnd(run)), 0) + " s of the scenario; it can go on";
}

}  // namespace mrose
