#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/experiment.h"
#include "io/progress.h"
#include "workflow/plugins.h"

namespace mrose {

/// An experiment that is to be run, and what is other than its file says.
struct ExperimentRequest {
    std::string file;    ///< or the name of one that ships
    std::string folder;  ///< for results.csv; made where it is missing
    std::optional<std::uint32_t> trials = {};
    std::vector<std::string> overrides = {};  ///< of its scenario, as of ScenarioRequest
    PluginUse plugins = {};
    std::vector<std::string> settings = {};  ///< likewise
    std::string command = {};                ///< as typed, for the page
};

/// How it is watched and ended; see ExperimentOptions. Each may be empty.
struct ExperimentWatch {
    std::function<void(const Experiment&)> opened = {};
    std::function<void(const RunKey&)> runBegins = {};
    std::function<void(std::int64_t done, std::int64_t all)> progress = {};
    GoesOn goesOn = {};
    std::function<Expected<void>(const RunKey&, const RowOutcome&)> fits = {};
};

/// Runs what is not done yet; when all is done, report.html says beside results.csv what it came to. Error: there is no
/// such experiment; as of readExperiment() and runExperiment() of experiment/experiment.h.
Expected<ExperimentSummary> runExperiment(const ExperimentRequest& request, const ExperimentWatch& watch = {});

}  // namespace mrose
