#pragma once

#include <span>

#include "logs/robot_log.h"
#include "motion/motion_network.h"

namespace mrose {

/// The limits of the drive with which a linear map of the commands that `blueprint` reads, of the wheels one with the
/// products of v and w, too, explains best how far the robots of the logs drove and turned. None where no such limits
/// leave a tenth less of the squares than none do, and of logs that never drive or never turn; none of the wheels where
/// v and w are not read over the same parts of the history.
ActuatorLimits identifyActuatorLimits(std::span<const Log> logs, const MotionNetwork& blueprint);

}  // namespace mrose
