#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiment/results_file.h"
#include "io/error.h"
#include "io/progress.h"
#include "scenario/scenario.h"
#include "tuning/tuner.h"
#include "tuning/tuning_file.h"

namespace mrose {

/// As of ExperimentOptions.
struct TuningOptions {
    ScenarioLoading loading = {};
    std::function<void(ScenarioParts&)> loaded = {};
    /// What reruns a trial of the experiment; " --set PATH=VALUE --trial 3 --seed 7" follows.
    std::string command = "mrose run", window = "mrose-gui";
    BatchIdentity identity;
    std::function<void(const RunKey&)> begins = {};
    /// Called with the evaluations until now, what is done of those in all, and the least cost so far (NaN: none), from
    /// any thread, one at a time. May be empty.
    std::function<void(std::int64_t done, std::int64_t all, double best)> progress = {};
    GoesOn goesOn = {};
};

/// For how much of the time some robot was driven as its network has not learned, from 0 to 1.
struct UnfamiliarDriving {
    double before = 0, tuned = 0;

    /// Of what was tuned, where that is worth one: "Tuned, in 12 % of the time ..."; else "".
    std::string note() const;
};

struct TuningSummary {
    TunerResult result;
    /// In the first trials held out, each with its first seed, of a complete result. nullopt: no motion network says.
    std::optional<UnfamiliarDriving> unfamiliar;
    std::int64_t resumed = 0;  ///< runs found done
    std::int64_t runs = 0;     ///< all that are done now: trials by seeds, those held out too
};

/// Tunes in the trials of an experiment. Each run's row is kept at once in `folder`/results.part.csv, of the variant
/// "candidate 1", "candidate 2", ...: who goes on with a folder asks the same again and finds what is done. With all
/// done, results.csv has them in order. The same for any number of threads. Error: of the trials and their expressions,
/// before the first run; a run has no cost and there is no `failure_cost`; as of runExperiment(); the folder has more
/// evaluations than are asked for.
Expected<TuningSummary> runTuning(const Tuning& tuning, const TuningOptions& options,
                                  const std::filesystem::path& folder);

}  // namespace mrose
