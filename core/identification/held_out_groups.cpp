#include "identification/held_out_groups.h"

#include <algorithm>
#include <string>

namespace mrose {

Expected<Log> partOf(Log log, const HoldOut& holdOut, LogPart part) {
    bool any = false;
    for (RobotLog& robot : log.robots) {
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
