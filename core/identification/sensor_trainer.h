#pragma once

#include <cstdint>

#include "identification/sensor_samples.h"
#include "io/error.h"
#include "io/progress.h"
#include "learning/regressor.h"
#include "perception/sensor_network.h"

namespace mrose {

/// How one half of a sensor is learned: whether there is a reading, or its error.
struct SensorHalfOptions {
    int hidden = 0;          ///< units
    int epochs = 0;          ///< at most
    double weightDecay = 0;  ///< of networks
    int folds = 2;           ///< parts that are held out in turn, fewer where the samples are too short
};

/// Part of the samples, whole blocks of time, is held out in turn: that gives the held-out score, and says how many
/// epochs are best. Then all samples are learned from, for so many epochs; but the errors of networks are of members
/// (ReadingForm), those that were learned without one part each.
struct SensorTrainerOptions {
    RegressorFamily family = RegressorFamily::network;
    int components = 4;  ///< of a member's mixture; tables and trees have 1
    SensorHalfOptions reported{.hidden = 16, .epochs = 400, .weightDecay = 1e-3, .folds = 3};
    /// Folds: of networks, at most ReadingForm::maxMembers; others have those of `reported`.
    SensorHalfOptions error{.hidden = 14, .epochs = 1300, .weightDecay = 2e-3, .folds = 6};
    int patience = 300;       ///< epochs without a better held-out likelihood after which a fold ends
    double roughness = 1e-5;  ///< of tables
    int trees = 40;           ///< for each output
    std::uint64_t seed = 1;
};

/// Learns the distribution of readings. `blueprint` says all that is not learned here: sensor, what it measures and
/// reports, robots, period, latency, view. Runs in the caller's oneTBB arena; the same samples, options and seed give
/// the same network whatever the number of threads. Error: too few looks or readings to learn from and to hold out;
/// more robots than can be told apart; likelihoods that are no numbers; `progress` ended it.
Expected<SensorNetwork> trainSensor(const SensorNetwork& blueprint, const SensorSamples& samples,
                                    const SensorTrainerOptions& asked, const Progress& progress = {});

}  // namespace mrose
