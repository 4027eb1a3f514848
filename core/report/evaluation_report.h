#pragma once

#include <filesystem>
#include <string>

#include "assessment/evaluate.h"
#include "report/page.h"

namespace mrose {

/// Error unless a report could be written into `folder`, or where one is there already, without `overwrite`: lets an
/// evaluation fail before its work. Nothing is made.
Expected<void> checkReportFolder(const std::filesystem::path& folder, bool overwrite = true);

/// Writes report.html (one file that needs nothing else), results.csv (one row per model and window), results.json
/// (all numbers) and windows.csv (which windows they are, as readWindows reads them) into `folder`, which is made where
/// it is missing. Each file appears whole or not at all. Error: no model was evaluated, a file cannot be written.
Expected<void> writeReport(const Evaluation& evaluation, const ReportContext& context,
                           const std::filesystem::path& folder);

std::string reportHtml(const Evaluation& evaluation, const ReportContext& context);

}  // namespace mrose
