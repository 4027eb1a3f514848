#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assessment/kick_scores.h"
#include "identification/kick_samples.h"
#include "io/error.h"
#include "report/page.h"

namespace mrose {

/// Which learned kicker is to be held against which log.
struct EvaluateKickerRequest {
    std::string network, log;
    std::vector<std::string> robots = {};  ///< whose kicks, by name; empty: all
    std::string command = {};              ///< what a report says that it was made by
};

struct KickerEvaluation {
    std::shared_ptr<const LearnedKicker> kicker;
    std::vector<KickScores> scores;  ///< the network's, then analytic kickers'
    KickSamples samples;
    bool synthetic = false;  ///< the log
    ReportContext context;
};

/// Error: a file, another kind of network; the log has no kick that meets a tracked ball.
Expected<KickerEvaluation> evaluateKicker(const EvaluateKickerRequest& request);

}  // namespace mrose
