#pragma once

#include <vector>

#include "scene/environment.h"
#include "scene/perception.h"
#include "sensing/sensor.h"

namespace mrose {

/// The sensors that every robot has (standardSensors()), of a robot whose perception is of the reference model, in an
/// environment: synthetic. Its odometry is as the numbers of `perception` say.
std::vector<SensorPointer> referenceSensors(const Perception& perception, const Environment& environment);

}  // namespace mrose
