#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "io/error.h"
#include "scenario/scenario.h"

namespace mrose {

/// Every trial (a start of its own, see varied()) with every seed (a noise of its own).
struct BatchOptions {
    std::uint32_t firstTrial = 1, trials = 100;
    std::uint64_t firstSeed = 1, lastSeed = 1;
    Nanoseconds duration = 60 * nanosecondsPerSecond;
    std::string until;  ///< a condition that ends a run; empty: none
    /// What the rows' commands begin with: "mrose run soccer.toml".
    std::string command = "mrose run";
    /// Identifies the scenario: a folder with results of another one is refused.
    std::string scenarioHash;
    /// Told how many runs are done of how many, from any thread, one at a time; false ends the batch, and what is done
    /// stays. May be empty.
    std::function<bool(std::int64_t, std::int64_t)> progress = {};
};

struct BatchSummary {
    std::int64_t runs = 0;     ///< in all
    std::int64_t resumed = 0;  ///< of them found done
    std::int64_t ended = 0;    ///< by the condition
    std::int64_t faulty = 0;   ///< with faults
    bool complete = false;     ///< results.csv is there
};

/// Runs what is not done yet and keeps each run's row at once in `folder`/results.part.csv, so that after a kill
/// nothing is repeated and no row lost; when all are done, results.csv has them in order. It is the same for any number
/// of threads (oneTBB's, as the caller limits them). Error: the folder belongs to another batch, cannot be written, or
/// the scenario or the condition is wrong.
Expected<BatchSummary> runBatch(const ScenarioParts& parts, const BatchOptions& options,
                                const std::filesystem::path& folder);

}  // namespace mrose
