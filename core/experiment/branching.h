#pragma once

#include <functional>
#include <memory>

#include "experiment/run.h"
#include "experiment/trial.h"

namespace mrose {

/// Where the variants of a trial part (Experiment::branch).
struct BranchPoint {
    std::shared_ptr<const Scenario> scenario;  ///< as it went until then
    /// `end` is RunEnd::condition where it branches, otherwise how it ended without.
    RunResult before;
    DrawnValues drawn;  ///< of the trial, with the instant
    bool isReached() const { return before.end == RunEnd::condition; }
};

/// How a trial goes from its start until it branches. What is given must outlive the run.
RunOptions untilBranch(Condition& branch, const Experiment& experiment, const Scenario& scenario,
                       const DrawnValues& drawn);

/// Runs a trial of an experiment that branches until it does, with the first seed. `goesOn` is asked after every tick
/// and may be empty. Error: the condition cannot be answered.
Expected<BranchPoint> runToBranch(const Experiment& experiment, TrialExpressions& expressions, ScenarioParts before,
                                  const DrawnValues& drawn, const std::function<bool()>& goesOn = {});

/// The state in which a variant goes on from there, with the noise of another seed from now on.
WorldState branchedState(const BranchPoint& point, const Scenario& variant, std::uint64_t seed);

}  // namespace mrose
