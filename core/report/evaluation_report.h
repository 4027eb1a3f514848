#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "assessment/evaluate.h"

namespace mrose {

/// What a report says beside the numbers. All of it is plain text.
struct ReportContext {
    std::string program;      ///< "mrose 0.1.0"
    std::string commandLine;  ///< that made the report
    bool synthetic = false;  ///< the log is made by a simulated robot: the report says so wherever it could be mistaken
    std::vector<std::string> notices;  ///< sentences that a reader must know before the numbers
    /// About the first model, which the report is about: "file", "inputs", "dead time", "seed", ... in this order.
    std::vector<std::pair<std::string, std::string>> modelFacts;
    std::vector<LogFile> trainingLogs;  ///< of the first model
    std::vector<std::size_t> chosen;    ///< further windows whose paths are shown, indices into Evaluation::windows
};

/// Error unless a report could be written into `folder`, or where one is there already, without `overwrite`: lets an
/// evaluation fail before its work. Nothing is made.
Expected<void> checkReportFolder(const std::filesystem::path& folder, bool overwrite = true);

/// Writes report.html (one file that needs nothing else), results.csv (one row per model and window), results.json
/// (all numbers) and windows.csv (which windows they are, as readWindows reads them) into `folder`, which is made where
/// it is missing. Each file appears whole or not at all. Error: no model was evaluated, a file cannot be written.
Expected<void> writeReport(const Evaluation& evaluation, const ReportContext& context,
                           const std::filesystem::path& folder);

std::string reportHtml(const Evaluation& evaluation, const ReportContext& context);

/// One row per model and window; metres, radians, seconds. Names are quoted where they need it.
std::string resultsCsv(const Evaluation& evaluation);

/// All numbers of an evaluation with their context. Keys end in their unit; what is not defined (an error over no
/// rotation) is null.
std::string resultsJson(const Evaluation& evaluation, const ReportContext& context);

}  // namespace mrose
