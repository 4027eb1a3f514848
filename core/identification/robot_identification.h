#pragma once

#include <span>
#include <vector>

#include "io/error.h"
#include "logs/robot_log.h"
#include "motion/motion_network.h"

namespace mrose {

/// Dead times and kinematic baselines of every robot of the logs, in the order in which they first appear; the logs of
/// robots of one name are pooled. A channel that cannot be identified keeps the defaults. Error: too little ground
/// truth.
Expected<std::vector<MotionNetwork::Identified>> identifyRobots(std::span<const Log> logs);

}  // namespace mrose
