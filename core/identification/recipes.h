#pragma once

#include <string>
#include <vector>

#include "motion/motion_network.h"
#include "motion/robot_traits.h"

namespace mrose {

/// How a robot answers commands: what a recipe is laid out for.
struct ResponseTimes {
    double deadTimeV = 0, lagV = 0, deadTimeW = 0, lagW = 0;  ///< s, of the mean response: jitter counts as lag
    double recoveryV = 0, recoveryW = 0;  ///< s, lags of the drive itself, by which a push is forgotten
    ActuatorLimits limits{};              ///< of the drive, where they are known
};

/// The network that we want people to use: form history. It reads the commands of the last few tenths of a second in
/// bins, finest where the dead time ends, and for wheel speeds in steps where between two steps the commands lie.
MotionNetwork historyBlueprint(const RobotTraits& traits, std::vector<std::string> robots, const ResponseTimes& times);

/// For robots whose motion depends on how fast they already are: form state, with the commands around the dead time in
/// bins of 50 ms, as the drive's limits let it follow them; where not both accelerations are limited, in coarser bins
/// for 0.7 s before, too. Meant to be learned on rollouts.
MotionNetwork stateBlueprint(const RobotTraits& traits, std::vector<std::string> robots, const ResponseTimes& times);

/// For robots that measure their own velocity: form state, to be learned on rollouts. What terrain makes of a command
/// shows in the velocity at the start; of the commands, a few coarse bins are enough beside it.
MotionNetwork velocityBlueprint(const RobotTraits& traits, std::vector<std::string> robots, const ResponseTimes& times);

/// The network of Buck, Beetz and Schmitt (2002): form state, with the mean command over the period as seen through the
/// dead time. No command issued after the period's start is read, so a dead time below the period counts the rest of it
/// as the newest command.
MotionNetwork paperBlueprint(const RobotTraits& traits, std::vector<std::string> robots, const ResponseTimes& times);

}  // namespace mrose
