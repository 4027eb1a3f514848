#pragma once

#include <functional>
#include <string>
#include <vector>

#include "assessment/evaluate.h"
#include "io/error.h"
#include "report/evaluation_report.h"

namespace mrose {

/// Which network is to be held against which log.
struct LogEvaluationRequest {
    std::string network, log;
    std::vector<std::string> robots = {};   ///< of the log, by name; empty: all
    std::vector<std::string> against = {};  ///< other networks, beside it
    double horizon = 10;                    ///< of a window, s
    bool heldOut = false;                   ///< only the part of the log that was kept from learning
    bool withFloor = true;
    std::vector<std::size_t> shown = {};  ///< windows whose paths a report shows too, by number from 1
};

/// What a report is written from.
struct LogEvaluation {
    Evaluation evaluation;
    ReportContext context;
};

/// Opens log and networks, and evaluates them and the kinematic baselines. `commandLine`: what the report says that it
/// was made by. `goesOn`: see evaluate(). Error: a file; a window that is not there; those of evaluate().
Expected<LogEvaluation> evaluateLog(const LogEvaluationRequest& request, const std::string& commandLine,
                                    const std::function<bool(double share)>& goesOn = {});

}  // namespace mrose
