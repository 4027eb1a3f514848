#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/error.h"
#include "validation/validation_results.h"

namespace mrose {

/// What a validation's page says beside the numbers; plain text.
struct ValidationContext {
    std::string program;       ///< "mrose 0.1.0"
    std::string commandLine;   ///< that made it
    std::string window;        ///< opens a list of runs: "mrose-gui"
    std::string folder;        ///< as it was given
    double seconds = 0;        ///< of computing
    std::int64_t resumed = 0;  ///< runs that were found done, of which `seconds` says nothing
};

/// The page: gains in the simulator and in the reality, what of them survives, where they disagree most, what it cost.
std::string validationReportHtml(const Validation& validation, const ValidationResult& result,
                                 const ResultsTable& results, const ValidationContext& context);

/// Writes report.html, validation.csv and disagreements.csv beside results.csv, in the place of older ones.
Expected<void> writeValidationReport(const Validation& validation, const ValidationResult& result,
                                     const ResultsTable& results, const ValidationContext& context,
                                     const std::filesystem::path& folder);

}  // namespace mrose
