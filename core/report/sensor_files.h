#pragma once

#include <string>

#include "assessment/sensor_assessment.h"
#include "report/page.h"

namespace mrose {

/// One row per model and robot, and one per model for all: scores in metres and radians, shares from 0 to 1.
std::string sensorResultsCsv(const SensorEvaluation& evaluation);

/// One row per case: what was true, what was reported, and what the first model made of it. mrose predict reads it as
/// queries.
std::string sensorCasesCsv(const SensorEvaluation& evaluation);

/// All figures with their context. Keys end in their unit; what is not defined is null.
std::string sensorResultsJson(const SensorEvaluation& evaluation, const ReportContext& context);

}  // namespace mrose
