#pragma once

#include "logs/robot_log.h"

namespace mrose {

/// Of another robot, what was driven beside a trajectory, on its clock: its trajectory of the same name, or its only
/// one; null: there is none. Clocks may start again in each trajectory, so that instants say nothing about which it is.
const Trajectory* trajectoryBeside(const Trajectory& own, const RobotLog& other);

}  // namespace mrose
