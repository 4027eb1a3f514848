#pragma once

#include <span>

#include "io/error.h"
#include "logs/robot_log.h"
#include "motion/kinematic.h"

namespace mrose {

/// What is fitted, each with all that the one before it has. The first of the kinematic baselines, velocity = command,
/// needs none: it is KinematicParameters{}.
enum class KinematicFit {
    deadTime,  ///< + a dead time for each channel
    dynamic    ///< + lag, gain, bias, and the sideways shift per rotation
};

/// Least squares of displacements within 0.16 s over all these robots' trajectories (one robot, or several pooled). All
/// commands of a channel have one dead time here, so that jitter turns up as lag: it is what predicts best, while
/// identifyDeadTimes tells them apart. A channel whose command never changes keeps its defaults. Error: too little
/// ground truth beside commands; `source` names the log in it.
Expected<KinematicParameters> fitKinematics(std::span<const RobotLog> robots, KinematicFit fit,
                                            const std::string& source = "log");

}  // namespace mrose
