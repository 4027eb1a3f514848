#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "validation/validation_results.h"
#include "workflow/run_experiment.h"

namespace mrose {

/// A validation that is to be run.
struct ValidateRequest {
    std::string file;                          ///< or the name of one that ships
    std::string folder;                        ///< for results.csv and the page; made where it is missing
    std::optional<std::uint32_t> trials = {};  ///< fewer than the file says
    PluginUse plugins = {};
    std::string commandLine = {};          ///< the page says that it was made by
    std::function<double()> seconds = {};  ///< since the work began, for the account; empty: it is not known
};

struct ValidatedBehaviour {
    Validation validation;
    ExperimentSummary summary;
    std::optional<ValidationResult> result;  ///< where all runs are done
};

/// Runs what is not done yet of its cells, as runExperiment() does; when all are done report.html, validation.csv and
/// disagreements.csv are written beside results.csv. Error: there is no such validation; as of readValidation(),
/// runExperiment() and validationResult(); more trials than the file says.
Expected<ValidatedBehaviour> validateBehaviour(const ValidateRequest& request, const ExperimentWatch& watch = {});

}  // namespace mrose
