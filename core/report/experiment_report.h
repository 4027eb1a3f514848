#pragma once

#include <string>

#include "experiment/experiment.h"
#include "report/page.h"

namespace mrose {

/// The page of an experiment all of whose runs are done: what each measure comes to, beside that of the other variants.
std::string experimentReport(const Experiment& experiment, const ExperimentSummary& summary,
                             const ReportContext& context);

}  // namespace mrose
