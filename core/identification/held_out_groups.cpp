#include "identification/held_out_groups.h"

#include <algorithm>
#include <string>

namespace mrose {

namespace {

template <class Stamped>
void eraseUntil(Nanoseconds time, std::vector<Stamped>& values) {
    std::erase_if(values, [&](const Stamped& value) { return value.time <= time; });
}

/// What is told of before the end of a held-out trajectory.
void forget(const Trajectory& heldOut, Trajectory& trajectory) {
    const Nanoseconds end = heldOut.poses.back().time;
    eraseUntil(end, trajectory.commands);
    eraseUntil(end, trajectory.blips);
    eraseUntil(end, trajectory.measuredVelocity);
    eraseUntil(end, trajectory.measuredRotation);
}

}  // namespace

bool continues(const Trajectory& trajectory, const Trajectory& other) {
    if (trajectory.commands.empty() || trajectory.poses.empty() || other.poses.empty()) return false;
    return other.poses.back().time <= trajectory.poses.front().time &&
           other.poses.back().time > trajectory.commands.front().time;
}

Expected<Log> partOf(Log log, const HoldOut& holdOut, LogPart part) {
    bool any = false;
    for (RobotLog& robot : log.robots) {
        for (Trajectory& trajectory : robot.trajectories)
            for (const Trajectory& other : robot.trajectories)
                if (part == LogPart::learned && holdOut.holds(other.group) && !holdOut.holds(trajectory.group) &&
                    continues(trajectory, other))
                    forget(other, trajectory);
        std::erase_if(robot.trajectories, [&](const Trajectory& trajectory) {
            return holdOut.holds(trajectory.group) != (part == LogPart::heldOut);
        });
        any = any || !robot.trajectories.empty();
    }
    if (any) return log;
    return fail(log.source, std::string("has no group of trajectories to ") +
                                (part == LogPart::heldOut ? "hold out" : "learn from besides those held out"));
}

}  // namespace mrose
