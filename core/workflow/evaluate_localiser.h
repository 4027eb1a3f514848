#pragma once

#include <vector>

#include "assessment/localiser_scores.h"
#include "workflow/open_sensors.h"

namespace mrose {

/// How true a learned localisation is: the network's scores first, at last those of an ideal one.
struct LocaliserEvaluation {
    std::string log;
    bool synthetic = false;
    SensorNetwork network;
    std::vector<LocaliserCase> cases;
    std::vector<LocaliserScores> scores;
    ReportContext context;
};

/// Opens log and networks, and evaluates them, an ideal localisation, and one with constant noise. `learns` is told of
/// the learning of families. Error: a file, another kind of network, another sensor; the log has no poses of such a
/// sensor beside ground truth; those of learnOtherFamilies().
Expected<LocaliserEvaluation> evaluateLocaliser(const EvaluateSensorRequest& request, const Progress& learns = {});

}  // namespace mrose
