#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "assessment/kick_scores.h"
#include "manipulation/learned_kicker.h"
#include "report/page.h"

namespace mrose {

/// What the page of `mrose evaluate` of a kicker is made of; all that it refers to outlives it.
struct KickReport {
    std::string log;
    bool synthetic = false;
    const LearnedKicker& kicker;
    std::span<const KickSample> kicks;
    std::span<const KickScores> scores;  ///< the kicker's first
};

/// As checkReportFolder() of motion models.
Expected<void> checkKickReportFolder(const std::filesystem::path& folder, bool overwrite);

/// Writes report.html (one file that needs nothing else), results.json (the scores) and kicks.csv (each kick: what it
/// depends on, what it did, and what was predicted) into `folder`, which is made where it is missing.
Expected<void> writeKickReport(const KickReport& report, const ReportContext& context,
                               const std::filesystem::path& folder);

std::string kickReportHtml(const KickReport& report, const ReportContext& context);

}  // namespace mrose
