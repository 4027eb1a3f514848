#pragma once

#include <string>

#include "assessment/sensor_assessment.h"

namespace mrose {

/// What errors have in common, from look to look and by robot, real beside the first model: a part of the page of
/// mrose evaluate of a sensor.
std::string errorLinkSection(const SensorEvaluation& evaluation);

}  // namespace mrose
