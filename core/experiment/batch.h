#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "experiment/results_row.h"
#include "io/error.h"
#include "io/progress.h"
#include "scenario/scenario.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// Every trial (a start of its own, see varied()) with every seed (a noise of its own).
struct BatchOptions {
    std::uint32_t firstTrial = 1, trials = 100;
    std::uint64_t firstSeed = 1, lastSeed = 1;
    Nanoseconds duration = 60 * nanosecondsPerSecond;
    std::string until;  ///< a condition that ends a run; empty: none
    /// What the rows' commands begin with; " --trial 3 --seed 7" follows: all else that a run depends on is in it.
    std::string command = "mrose run";
    /// If given, kept beside the results as `scenario.value` (value_file.h) when all are there: what the trials are of.
    std::shared_ptr<const ScenarioValue> value = nullptr;
    /// What all runs depend on. A folder with results of another identity is refused.
    BatchIdentity identity;
    /// Called with the run that this thread begins, from any thread. May be empty.
    std::function<void(const RunKey&)> begins = {};
    /// Called with how many runs are done of how many, from any thread, one at a time. May be empty.
    std::function<void(std::int64_t, std::int64_t)> progress = {};
    /// Asked after every tick, from any thread; false ends the batch, and runs that are done stay. May be empty.
    GoesOn goesOn = {};
};

/// More runs than this are refused.
constexpr std::int64_t mostRuns = 10'000'000;

struct BatchSummary {
    std::int64_t runs = 0;     ///< in all
    std::int64_t resumed = 0;  ///< of them found done
    ResultsSummary results;    ///< of all that are done now
    bool complete = false;     ///< results.csv is there
};

/// Runs what is not done yet and keeps each run's row at once in `folder`/results.part.csv, so that after a kill
/// nothing is repeated and no row lost; when all are done, results.csv has them in order. It is the same for any number
/// of threads (oneTBB's, as the caller limits them). A folder whose runs are all among those asked for is gone on with:
/// so more trials and seeds can be added. Error: too many runs; the folder belongs to another batch or has other runs,
/// is in use by one, or cannot be written; the scenario or the condition is wrong.
Expected<BatchSummary> runBatch(const ScenarioParts& parts, const BatchOptions& options,
                                const std::filesystem::path& folder);

}  // namespace mrose
