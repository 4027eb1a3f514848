#pragma once

#include <string>

#include "assessment/sensor_assessment.h"

namespace mrose {

/// What one robot had before it at SensorEvaluation::shown, from above, with what it reported.
std::string lookFigure(const SensorEvaluation& evaluation);

/// Each of its subjects that was reported or is likely to be, enlarged: what the first model would report, by so many
/// draws, and what was.
std::string lookCloseUps(const SensorEvaluation& evaluation);
constexpr int shownDraws = 40;
constexpr double leastShownChance = 0.05;

std::string lookLegend(const SensorEvaluation& evaluation);

}  // namespace mrose
