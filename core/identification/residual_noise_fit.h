#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "identification/motion_samples.h"
#include "io/progress.h"
#include "motion/motion_network.h"
#include "motion/residual_noise.h"

namespace mrose {

/// Rollouts of a network over what it was not learned from: what it predicted, what became of it, and all that its
/// noise depends on.
struct ResidualRollouts {
    std::size_t length = 0, members = 0;  ///< periods of each; networks of the ensemble
    std::vector<Pose> truth, mean;        ///< increments [rollout][period]
    std::vector<NoiseTraits> traits;      ///< [rollout][period]
    std::vector<Pose> deviations;         ///< members' increments less the mean's, [rollout][period][member]

    std::size_t count() const { return length == 0 ? 0 : truth.size() / length; }
};

/// The longest rollouts that a noise can be learned from; and the shortest, in seconds.
constexpr double longestResidual = 10, shortestResidual = 1;

/// How long rollouts may be of which samples have so many that something can be learned from them, in periods: 10 s, or
/// what most runs are long enough for; 0: they are too short or too few.
std::size_t residualLength(const MotionSamples& samples);

/// Adds the rollouts of `network` over samples that it was not learned from, `length` long, with starts 3 s apart or a
/// third of the length. Each begins where the robot was measured to be, and as fast (MotionSample::measured), as a
/// prediction does.
void addResidualRollouts(const MotionNetwork& network, const MotionSamples& samples, std::size_t length,
                         ResidualRollouts& rollouts);

struct ResidualNoiseOptions {
    int samples = 48;  ///< of each rollout; even
    int epochs = 60;
    std::uint64_t seed = 1;
};

/// The noise with which sampled rollouts forecast these best: their mean EnergyLoss is made small. Deterministic for
/// any number of threads. Cancelled by `progress`: what was found until then.
ResidualNoise fitResidualNoise(const ResidualRollouts& rollouts, Nanoseconds period,
                               const ResidualNoiseOptions& options = {}, const Progress& progress = {});

/// Of noises that are drawn anew in each period, in proportion to distance and rotation, the one that forecasts these
/// best: what another noise must do better than.
MotionNoise fitConstantNoise(const ResidualRollouts& rollouts, Nanoseconds period,
                             const ResidualNoiseOptions& options = {}, const Progress& progress = {});

/// What fitResidualNoise makes small: the mean EnergyLoss of rollouts sampled with this noise, m.
double residualLoss(const ResidualNoise& noise, const ResidualRollouts& rollouts, Nanoseconds period,
                    const ResidualNoiseOptions& options = {});

}  // namespace mrose
