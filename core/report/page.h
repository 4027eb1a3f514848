#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/metrics.h"
#include "io/error.h"
#include "io/file.h"

namespace mrose {

// What reports are put together from; all contents are markup.

/// A whole page that needs nothing else, with its style sheet.
std::string reportPage(std::string_view title, std::string_view body);

std::string heading(std::string_view content);
std::string paragraph(std::string_view content);
/// A term of a list of definitions, and what it means.
std::string definition(std::string_view term, std::string_view meaning);
std::string card(std::string_view title, std::string_view content);
std::string tableCard(std::string_view content);

/// "2.65 %", never broken between the number and its unit.
std::string percentText(double value);

/// Of fewer windows a bootstrap's interval or a 90th percentile says nothing, and pages leave it out.
constexpr std::size_t leastForInterval = 20, leastForPercentile = 10;

/// The distribution's 90th percentile, or nothing where it is of too few.
std::string p90Text(const Distribution& distribution, double unit, int decimals);

/// P, Hd and the errors at the end, large.
std::string tiles(const Summary& summary);

/// Error unless files of these names could be written into `folder`, which need not be there, or where one is there
/// already, without `overwrite`. Nothing is made.
Expected<void> checkReportFolder(const std::filesystem::path& folder, std::span<const char* const> names,
                                 bool overwrite);

/// Writes files, whose paths are seen from `folder`, which is made where it is missing: all of them or none.
Expected<void> writeReportFiles(const std::filesystem::path& folder, std::vector<NamedFile> files);

}  // namespace mrose
