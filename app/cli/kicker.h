#pragma once

#include "common.h"
#include "workflow/evaluate_kicker.h"
#include "workflow/train_kicker.h"

namespace mrose::cli {

/// What train and evaluate do of kickers. Give an exit status.
int runTrainKicker(const TrainKickerRequest& request, const CommonFlags& common);
/// `folder`: for the report; empty: none.
int runEvaluateKicker(const EvaluateKickerRequest& request, const std::string& folder, const CommonFlags& common);

}  // namespace mrose::cli
