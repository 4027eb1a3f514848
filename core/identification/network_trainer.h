#pragma once

#include <functional>
#include <string>

#include "identification/motion_samples.h"
#include "identification/rollout_batch.h"
#include "learning/trainer.h"

namespace mrose {

enum class LearningLoss { oneStep, rollout };

struct NetworkTrainerOptions {
    TrainingMethod method = TrainingMethod::irpropPlus;
    LearningLoss loss = LearningLoss::rollout;
    int hidden = 32;  ///< units of each member
    int members = 4;  ///< networks learned with other folds held out, whose mean is one network of one hidden layer
    int rolloutLength = 20;  ///< periods of a chain that is learned from; fewer where no run is so long
    int epochs = 1000;       ///< at most
    int patience = 300;      ///< epochs without a better open-loop error after which learning stops
    int evaluateEvery = 10;  ///< epochs
    double horizon = 10;     ///< s, of the held-out chains; shorter where the runs are
    std::uint64_t seed = 1;
    bool linearStart = false;  ///< startLinear(): for networks whose outputs mostly go on as their inputs are
    RolloutLoss rolloutLoss;
};

struct NetworkProgress {
    int member = 0, members = 1;  ///< 0 is the first
    int epoch = 0, epochs = 0;
    double loss = 0;
    OpenLoopError heldOut = {};  ///< best so far, of this member
    bool ofNoise = false;        ///< of a network that only its noise is learned from (learn_noise.h)
    int membersOfNoise = 0;      ///< how many of `members` are such
};

/// Called about every evaluateEvery epochs; false ends learning with the best network so far.
using NetworkProgressCallback = std::function<bool(const NetworkProgress&)>;

struct TrainedNetwork {
    MotionNetwork network;  ///< with layers, scales, heldOut and training.{method, loss, seed, patterns, epochs}
    bool cancelled = false;
    bool noiseOfKnownRobots = false;  ///< its noise was learned without robots that a network did not know
    std::string withoutNoise = {};    ///< why the network knows its mean alone, where its noise was to be learned
};

/// The fewest parts that logs are divided into, held out in turn.
constexpr int leastFolds = 2;

/// Learns a motion network open loop. `blueprint` says form, robots, period, inputs (their scales are found here),
/// recovery. Runs in the caller's oneTBB arena; the same samples, options and seed give the same network whatever the
/// number of threads. Levenberg-Marquardt needs LearningLoss::oneStep. Error: too few patterns to learn from and to
/// hold out.
Expected<TrainedNetwork> trainNetwork(const MotionNetwork& blueprint, const MotionSamples& samples,
                                      const NetworkTrainerOptions& options,
                                      const NetworkProgressCallback& progress = {});

}  // namespace mrose
