#pragma once

#include <span>
#include <vector>

#include "identification/dead_time.h"
#include "identification/drive_fit.h"
#include "motion/motion_network.h"

namespace mrose {

/// What `inspect` shows of a robot.
using ChannelResponse = ChannelDelay;
using RobotResponse = DeadTimes;
RobotResponse identifyResponse(const RobotLog& robot);

/// For each robot, over all logs in which it occurs, in the order in which they do: the dynamic kinematic baseline and
/// the standard errors of the dead times (0 where a channel is not identifiable). Trackers keep their defaults. Error:
/// a robot with too little ground truth, named by its log.
Expected<std::vector<MotionNetwork::Identified>> identifyRobots(std::span<const Log> logs);

/// Geometry of a log of wheel commands that was read with the default drive; measured wheel speeds are taken where the
/// log has them, because wheels slip and do not reach what they are told.
Expected<DriveFit> fitDrive(const Log& log);

}  // namespace mrose
