#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "assessment/localiser_scores.h"
#include "report/page.h"

namespace mrose {

/// What the page of `mrose evaluate` of a learned localisation is made of; all that it refers to outlives it.
struct LocaliserReport {
    std::string log;
    bool synthetic = false;
    const SensorNetwork& network;
    std::span<const LocaliserCase> cases;
    std::span<const LocaliserScores> scores;  ///< the network's first
};

/// As checkReportFolder() of motion models.
Expected<void> checkLocaliserReportFolder(const std::filesystem::path& folder, bool overwrite);

/// Writes report.html (one file that needs nothing else), results.json (the scores) and poses.csv (each instant: state,
/// error, and what was predicted of it) into `folder`, which is made where it is missing.
Expected<void> writeLocaliserReport(const LocaliserReport& report, const ReportContext& context,
                                    const std::filesystem::path& folder);

std::string localiserReportHtml(const LocaliserReport& report, const ReportContext& context);

/// As `mrose evaluate --json` of a localisation prints it.
std::string localiserScoresJson(const LocaliserReport& report, const ReportContext& context);

}  // namespace mrose
