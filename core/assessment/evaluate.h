#pragma once

#include <span>
#include <string>
#include <vector>

#include "assessment/assess.h"
#include "assessment/forecast.h"
#include "assessment/named_model.h"
#include "io/progress.h"

namespace mrose {

struct EvaluationOptions {
    std::vector<std::string> robots{};  ///< as the log names them; empty: all
    WindowOptions windows{};
    std::vector<double> relativeHorizons{0.1, 1, 5, 10};  ///< s
    bool withFloor = true;
    FloorOptions floor{};
    /// Near-identical commands over a whole window go straight as a rule. What turns needs shorter stretches.
    FloorOptions turningFloor{
        .pathBound = 0.01, .rotationBound = 0.05, .horizon = 5'000'000'000LL, .leastTurnRate = 0.05};
};

/// Models against a log; all that a report needs.
struct Evaluation {
    LogWindows log;
    std::vector<Assessment> models;        ///< in the order given
    std::vector<Forecast> forecasts = {};  ///< of models whose noise is known: forecast()
};

/// Rolls every model out over every window of the log and compares with the truth. The result is the same for any
/// number of threads. Error: no windows (see findWindows); a model that knows one of the robots not, whose period does
/// not divide the step, or that predicts something that is not finite; `progress`
/// ended it.
Expected<Evaluation> evaluate(const Log& log, std::span<const NamedModel> models, const EvaluationOptions& options = {},
                              const Progress& progress = {});

}  // namespace mrose
