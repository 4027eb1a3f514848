#pragma once

#include <vector>

#include "motion/motion_model.h"
#include "scenario/scenario.h"
#include "world/command.h"

namespace mrose {

/// The commands that one robot was given and still remembers.
struct DeadTimeQueue {
    std::vector<StampedCommand> commands;  ///< oldest first
    Command before;                        ///< in force before those
    Nanoseconds now = 0;
    MotionModel::DeadTimes deadTimes;
    Nanoseconds period = 0;       ///< between control instants; 0: unknown
    Nanoseconds lastInstant = 0;  ///< the last one
};
DeadTimeQueue deadTimeQueueOf(const Scenario& scenario, const WorldState& state, std::size_t robot);

/// The command that takes effect now, and those still on their way with the time until they do, in order.
struct CommandsOnTheWay {
    Command active;
    struct Coming {
        StampedCommand issued;
        Nanoseconds untilV = 0, untilW = 0;  ///< 0: already in effect
    };
    std::vector<Coming> coming;
};
CommandsOnTheWay commandsOnTheWay(const DeadTimeQueue& queue);

}  // namespace mrose
