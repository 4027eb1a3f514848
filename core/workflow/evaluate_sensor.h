#pragma once

#include <string>
#include <vector>

#include "assessment/sensor_assessment.h"
#include "io/progress.h"
#include "report/page.h"

namespace mrose {

/// Which learned sensor is to be held against which log.
struct EvaluateSensorRequest {
    std::string network, log;
    std::vector<std::string> robots = {};   ///< whose sensors are judged, by name; empty: all. The others occlude
    std::vector<std::string> against = {};  ///< other networks of such a sensor, beside it
    bool families = false;                  ///< the other families beside it, learned from the same logs
    std::string command = {};               ///< what a report says that it was made by
};

/// What a report is written from.
struct SensorNetworkEvaluation {
    SensorEvaluation evaluation;
    ReportContext context;
};

/// Whether a network file is of a sensor. Error: it cannot be read.
Expected<bool> isSensorFile(const std::string& path);

/// Opens log and networks, and evaluates them, an ideal sensor, and that with constant noise. `learns` is told of the
/// learning of families. Error: a file, another kind of network, another sensor; those of loggedCases() and
/// learnOtherFamilies().
Expected<SensorNetworkEvaluation> evaluateSensor(const EvaluateSensorRequest& request, const Progress& learns = {},
                                                 const Progress& progress = {});

}  // namespace mrose
