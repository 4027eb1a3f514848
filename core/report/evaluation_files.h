#pragma once

#include <string>

#include "assessment/evaluate.h"
#include "report/page.h"

namespace mrose {

/// One row per model and window; metres, radians, seconds. Names are quoted where they need it.
std::string resultsCsv(const Evaluation& evaluation);

/// All numbers of an evaluation with their context. Keys end in their unit; what is not defined (an error over no
/// rotation) is null.
std::string resultsJson(const Evaluation& evaluation, const ReportContext& context);

}  // namespace mrose
