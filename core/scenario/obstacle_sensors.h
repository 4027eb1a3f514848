#pragma once

#include <vector>

#include "behaviour/obstacle_memory.h"
#include "scene/robot_type.h"

namespace mrose {

/// Those of a robot's sensors that find what is around it, as its controller knows them: lasers, sonars, infrared,
/// bumpers, in this order.
std::vector<ObstacleSensor> obstacleSensors(const RobotType& robot);

}  // namespace mrose
