#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "experiment/batch.h"
#include "io/progress.h"
#include "workflow/open_scenario.h"

namespace mrose {

/// Which trials of a scenario are run, with which seeds.
struct BatchRequest {
    ScenarioRequest scenario;             ///< its trial does not count
    std::string folder;                   ///< for results.csv; made where it is missing
    std::optional<double> duration = {};  ///< s; otherwise what the scenario says
    std::string until = {};               ///< a condition that ends a run; empty: none
    std::uint32_t trials = 100;
    struct Seeds {
        std::uint64_t first = 1, last = 1;
    };
    std::optional<Seeds> seeds = {};  ///< each with every trial; otherwise the scenario's
};

/// How a batch is watched and ended; see BatchOptions. Each may be empty.
struct BatchWatch {
    std::function<void(const OpenedScenario&)> opened = {};
    std::function<void(const RunKey&)> runBegins = {};
    std::function<void(std::int64_t done, std::int64_t all)> progress = {};
    GoesOn goesOn = {};
};

/// Runs what is not done yet. Error: as of openScenario(), openCondition() and of the runBatch() of experiment/batch.h.
Expected<BatchSummary> runBatch(const BatchRequest& request, const BatchWatch& watch = {});

}  // namespace mrose
