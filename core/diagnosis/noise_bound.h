#pragma once

#include "diagnosis/divergence.h"
#include "motion/learned_model.h"

namespace mrose {

struct NoiseBoundOptions {
    int runs = 128;
    double leaving = 0.01;  ///< share of such a robot's own runs that are beyond the bound somewhere
    /// What is added to how far runs stray, in squares: else the first instants, at which hardly any do, would make the
    /// bound wide later on.
    DivergenceBound::At floor{0.005, std::numbers::pi / 180};
    /// What a tracker's noise and the measured start may make of the first instants.
    DivergenceBound::At least{0.01, 1.5 * std::numbers::pi / 180};
};

/// The bound within which a robot's own runs stay: so many times as far as runs with the noise of its network are from
/// their mean (root mean square at each instant, position and heading), that the share `leaving` of these runs is
/// beyond it for `held`. The share is that of a log-normal distribution fitted to how often each run would fit in.
/// `model` knows its noise; `trajectory` is what `rollout` was driven from.
DivergenceBound noiseBound(const LearnedModel& model, const Trajectory& trajectory, const ComparedRollout& rollout,
                           Nanoseconds step, Nanoseconds held, const NoiseBoundOptions& options = {});

}  // namespace mrose
