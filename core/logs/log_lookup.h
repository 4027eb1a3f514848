#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "logs/robot_log.h"

namespace mrose {

/// Of another robot, what was driven beside a trajectory, on its clock: its trajectory of the same name, or its only
/// one; null: there is none. Clocks may start again in each trajectory, so that instants say nothing about which it is.
const Trajectory* trajectoryBeside(const Trajectory& own, const RobotLog& other);

/// What the sensor of that name reported in a trajectory; null: the trajectory has none.
const SensorLog* findSensor(const Trajectory& trajectory, std::string_view name);

/// Whether that sensor looked for subjects in any of a robot's trajectories.
bool hasLooks(const RobotLog& robot, std::string_view sensor);

/// The names of all sensors of a log's robots, each once, in the order of robots and trajectories.
std::vector<std::string> sensorNames(const Log& log);

}  // namespace mrose
