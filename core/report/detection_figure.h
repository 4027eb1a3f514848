#pragma once

#include <string>

#include "assessment/sensor_assessment.h"

namespace mrose {

/// Which share of the subjects is reported in each part of the field of view, as colours: real, or as predicted.
enum class DetectionSide { real, predicted };
std::string detectionFigure(const SensorEvaluation& evaluation, DetectionSide side);

/// What the colours mean.
std::string shareLegend(const SensorEvaluation& evaluation);

}  // namespace mrose
