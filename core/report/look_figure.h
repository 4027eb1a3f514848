#pragma once

#include <string>

#include "assessment/sensor_assessment.h"

namespace mrose {

/// What one robot had before it at SensorEvaluation::shown, from above, with what it reported.
std::string realLookFigure(const SensorEvaluation& evaluation);
/// The same with what the first model would report, by so many draws.
std::string predictedLookFigure(const SensorEvaluation& evaluation);
constexpr int shownDraws = 40;

std::string lookLegend(const SensorEvaluation& evaluation);

}  // namespace mrose
