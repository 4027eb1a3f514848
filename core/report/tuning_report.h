#pragma once

#include <string>

#include "report/page.h"
#include "tuning/tuning_file.h"
#include "tuning/tuning_run.h"

namespace mrose {

/// The page of `mrose tune`, of a complete result: what was found and the evidence for it; the best cost over the
/// evaluations, and the cost against each parameter. `context`: what says it and by what command, and notices.
std::string tuningReport(const Tuning& tuning, const TuningSummary& summary, const ReportContext& context);

/// As `mrose tune --json` prints it; `folder`: of the files.
std::string tuningJson(const Tuning& tuning, const TuningSummary& summary, const std::string& folder);

}  // namespace mrose
