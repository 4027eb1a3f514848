#pragma once

#include <string>
#include <vector>

#include "assessment/sensor_assessment.h"
#include "io/progress.h"
#include "report/page.h"
#include "workflow/open_sensors.h"

namespace mrose {

/// What a report is written from.
struct SensorNetworkEvaluation {
    SensorEvaluation evaluation;
    ReportContext context;
};

/// Opens log and networks, and evaluates them, an ideal sensor, and that with constant noise. `learns` is told of the
/// learning of families. Error: a file, another kind of network, another sensor; those of loggedCases() and
/// learnOtherFamilies().
Expected<SensorNetworkEvaluation> evaluateSensor(const EvaluateSensorRequest& request, const Progress& learns = {},
                                                 const Progress& progress = {});

}  // namespace mrose
