#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "diagnosis/divergence_cause.h"

namespace mrose {

/// Which divergences of a comparison are looked for, and why.
struct DivergenceOptions {
    DivergenceBound bound{};  ///< the constants, and for how long
    /// Instead of the constants what each robot's network knows of real runs: BoundSource.
    bool fromNetwork = false;
    std::vector<OtherModel> models{};
    /// The causes of so many rollouts are looked for, of those that diverge the ones with the largest mean error; of a
    /// single rollout those of all robots. 0: of none.
    std::size_t diagnosed = 50;
    Progress progress{};  ///< of looking for causes; called from any thread, one at a time
};

/// A robot that leaves the real trajectory.
struct RolloutDivergence {
    std::size_t rollout = 0;  ///< in Comparison::rollouts
    Divergence divergence;
    std::optional<Diagnosis> diagnosis;  ///< nullopt: not looked for
};

/// The first divergences of a comparison's rollouts.
struct ComparedDivergences {
    DivergenceBound bound;  ///< the constants
    /// Of a robot at least; the others' bounds are made of what their networks know, or of the constants.
    BoundSource source = BoundSource::constant;
    bool ofAll = true;                        ///< every compared robot's is made of that
    std::vector<RolloutDivergence> rollouts;  ///< those that diverge, as in Comparison::rollouts
    struct Summary {
        std::size_t rollouts = 0, diverging = 0;  ///< rollouts: those that were simulated
        double medianTime = 0;                    ///< s, of those that diverge; not a number of none
    };
    std::vector<Summary> robots;  ///< by compared robot
    Summary all;
    bool cancelled = false;

    const RolloutDivergence* of(std::size_t rollout) const;  ///< null: it does not diverge
};

/// Indices into `found.rollouts` of at most so many, those with the largest mean errors, the worst first; of a single
/// rollout those of all robots.
std::vector<std::size_t> worstOf(const Comparison& comparison, const ComparedDivergences& found, std::size_t most);
/// So many are listed one by one.
constexpr std::size_t shownDivergences = 5;

/// The most that a network of any of the robots knows.
BoundSource boundSource(const LogWorld& world);
/// The least.
BoundSource leastBoundSource(const LogWorld& world);

/// The bound that the network of a rollout's robot makes; nullopt: it has none, or one that knows nothing of real runs.
/// `request` is what the rollout was driven of.
std::optional<DivergenceBound> networkBound(const LogWorld& world, const RolloutRequest& request,
                                            const ComparedRollout& rollout, Nanoseconds step, Nanoseconds held);

/// Finds where each rollout of `comparison` diverges, and why. The result is the same for any number of threads. Error:
/// as for diagnose().
Expected<ComparedDivergences> divergencesOf(const LogWorld& world, const Comparison& comparison,
                                            const DivergenceOptions& options);

}  // namespace mrose
