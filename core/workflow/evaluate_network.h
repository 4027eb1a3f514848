#pragma once

#include <string>
#include <vector>

#include "assessment/evaluate.h"
#include "io/progress.h"
#include "report/evaluation_report.h"

namespace mrose {

/// Which network is to be held against which log.
struct EvaluateRequest {
    std::string network, log;
    std::vector<std::string> robots = {};   ///< of the log, by name; empty: all
    std::vector<std::string> against = {};  ///< other networks, beside it
    double horizon = 10;                    ///< of a window, s
    bool heldOut = false;                   ///< only the part of the log that was kept from learning
    bool withFloor = true;
    bool withAdvice = false;              ///< what to drive next, for a report
    int samples = 64;                     ///< rollouts of each window by which a noise is judged
    std::vector<std::size_t> shown = {};  ///< windows whose paths a report shows too, by number from 1
    std::string command = {};             ///< what a report says that it was made by
};

/// What a report is written from.
struct NetworkEvaluation {
    Evaluation evaluation;
    ReportContext context;
};

/// Opens log and networks, and evaluates them and the kinematic baselines. Error: a file; a window that is not there;
/// those of evaluate().
Expected<NetworkEvaluation> evaluateNetwork(const EvaluateRequest& request, const Progress& progress = {});

}  // namespace mrose
