#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "io/error.h"
#include "tuning/tuned_parameter.h"

namespace mrose {

/// What is searched for, and how much for.
struct TunerOptions {
    std::vector<TunedParameter> parameters;
    std::uint32_t trials = 64;     ///< in which candidates are compared: those from 1 on
    std::uint32_t heldOut = 200;   ///< in which nothing was searched: those after them
    std::int64_t evaluations = 0;  ///< candidates by trials, at most; those held out do not count
    std::uint64_t seed = 1;        ///< of the search
    bool racing = true;            ///< false: each candidate is run in all trials
};

/// A value for each parameter, and what it came to.
struct Candidate {
    std::vector<double> values;
    std::vector<double> costs;  ///< of the trials that were run, from the first on
    /// The mean of all trials; where it was dropped, the incumbent's and by how much it cost more in those that were
    /// run.
    double cost = 0;
    bool dropped = false;
    bool best = false;             ///< of all before it, which makes it the incumbent
    std::int64_t evaluations = 0;  ///< spent until it was done
};

struct TunerResult {
    std::vector<Candidate> candidates;  ///< what is now first
    std::size_t best = 0;
    std::int64_t evaluations = 0;
    std::vector<double> before, after;  ///< costs on what was held out, of the first candidate and the best, by trial
    bool complete = false;              ///< false: stopped
};

/// The costs of a candidate, which counts from 0, in `count` trials from `first` on. Fewer: it was stopped.
using TrialCosts = std::function<Expected<std::vector<double>>(std::size_t candidate, const std::vector<double>& values,
                                                               std::uint32_t first, std::uint32_t count)>;
/// Called when a candidate is done, with evaluations, and the least cost so far.
using TunerProgress = std::function<void(std::int64_t evaluations, double best)>;

/// Searches the least expected cost: candidates race (Race) against the best so far in the same trials. Which are asked
/// for depends on the options and the costs alone, and more `evaluations` only add to them. Error: the first of
/// `costs`.
Expected<TunerResult> tune(const TunerOptions& options, const TrialCosts& costs, const TunerProgress& progress = {});

}  // namespace mrose
