#pragma once

#include <string>

#include "common.h"
#include "workflow/evaluate_sensor.h"

namespace mrose::cli {

/// mrose evaluate of a sensor; `folder`: of the report, "" for none.
int runEvaluateSensor(const EvaluateSensorRequest& request, const std::string& folder, const CommonFlags& common);
/// The same of a robot's own localisation.
int runEvaluateLocaliser(const EvaluateSensorRequest& request, const std::string& folder, const CommonFlags& common);

}  // namespace mrose::cli
