#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/compared_divergences.h"
#include "report/page.h"
#include "scene/scene.h"

namespace mrose {

/// Error unless a report could be written into `folder`: lets a comparison fail before its work. Nothing is made.
Expected<void> checkComparisonFolder(const std::filesystem::path& folder, bool overwrite = true);

/// Writes report.html (one file that needs nothing else), errors.csv, rollouts.csv and results.json into `folder`,
/// which is made where it is missing, and readings.csv where sensors were compared. Each file appears whole or not at
/// all. `scene` is what the pictures show round the paths; where they diverge is said where `divergences` is given.
Expected<void> writeComparison(const Comparison& comparison, const Scene& scene, const ReportContext& context,
                               const std::filesystem::path& folder, const ComparedDivergences* divergences = nullptr);

/// Plain sentences: what was left out of the figures and why, contacts, faults. For tables and reports alike.
std::vector<std::string> remarksOn(const Comparison& comparison);

std::string comparisonHtml(const Comparison& comparison, const Scene& scene, const ReportContext& context,
                           const ComparedDivergences* divergences = nullptr);

}  // namespace mrose
