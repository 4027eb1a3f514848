#pragma once

#include <string>

#include "assessment/evaluate.h"
#include "report/page.h"

namespace mrose {

/// Of one motion network and a team's own log: how true, how certain, where not to trust it, what to drive next. On one
/// page, which prints on one side of A4; it needs nothing else. The evaluation has a model and a window.
std::string sheetHtml(const Evaluation& evaluation, const ReportContext& context);

}  // namespace mrose
