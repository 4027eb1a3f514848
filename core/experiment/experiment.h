#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/estimates.h"
#include "experiment/experiment_file.h"
#include "experiment/results_file.h"
#include "experiment/run.h"
#include "io/error.h"
#include "io/progress.h"

namespace mrose {

/// What a row of the results says of the run.
struct RowOutcome {
    bool faulty = false;           ///< it ended by a fault
    std::vector<double> measures;  ///< to the last bit; NaN where it is not known
    std::string fault = {};        ///< which one
};

struct ExperimentOptions {
    /// Its loader of plug-ins is called by several threads at once.
    ScenarioLoading loading = {};
    std::function<void(ScenarioParts&)> loaded = {};  ///< called with each trial's scenario, likewise. May be empty
    /// What reruns the experiment's trials; `flags` of the variant and " --trial 3 --seed 7" follow.
    std::string command = "mrose run", window = "mrose-gui";
    std::function<std::string(const Variant&)> flags = {};  ///< beginning with a blank. May be empty
    /// What all rows depend on. A folder with results of another identity is refused.
    BatchIdentity identity;
    std::function<void(const RunKey&)> begins = {};                          ///< as of BatchOptions
    std::function<void(std::int64_t done, std::int64_t all)> progress = {};  ///< likewise
    GoesOn goesOn = {};                                                      ///< likewise
    /// Asked what a run came to, before its row is kept; an error ends all. May be empty.
    std::function<Expected<void>(const RunKey&, const RowOutcome&)> fits = {};
};

/// What the runs of a variant have of a feature or a measure.
struct MeasureSummary {
    std::string name;        ///< of its column: "measure.time_s"
    std::int64_t count = 0;  ///< of those that have a number
    double mean = 0, deviation = 0, least = 0, most = 0;
    bool share = false;  ///< all are 0 or 1: the mean is a share
    Estimate estimate;   ///< the mean over trials with its interval, of a share Wilson's; not beyond what is possible
};

struct VariantSummary {
    std::string name;
    std::optional<SweepPoint> sweep;
    std::int64_t runs = 0;
    std::int64_t ended = 0;   ///< by `until`
    std::int64_t faulty = 0;  ///< by a fault
    std::string firstFault;   ///< with its trial
    std::vector<MeasureSummary> measures;
};

struct ExperimentSummary {
    std::int64_t runs = 0;     ///< in all
    std::int64_t resumed = 0;  ///< of them found done
    std::int64_t done = 0;     ///< now
    std::vector<VariantSummary> variants;
    bool complete = false;  ///< results.csv is there
    bool until = false;     ///< a condition may end runs before their time
};

/// Runs what is not done yet, each trial with each seed by each variant. A row is kept at once in
/// `folder`/results.part.csv; when all are done, results.csv has them in order. It is the same for any number of
/// threads. A run ends by `until`, at a fault, or after the experiment's duration; what was wrong is in its row, also
/// where its trial cannot be made or an expression not be answered. Error: of the expressions and of what trials are
/// made of, as far as the first trial and the ends of draws tell, before the first run; as of runBatch().
Expected<ExperimentSummary> runExperiment(const Experiment& experiment, const ExperimentOptions& options,
                                          const std::filesystem::path& folder);

}  // namespace mrose
