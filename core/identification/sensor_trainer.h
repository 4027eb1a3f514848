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
    int hidden = 12;     ///< units of a member
    int epochs = 600;    ///< at most
    int patience = 150;  ///< epochs without a better held-out likelihood after which learning stops
    double weightDecay = 1e-4;  ///< of networks
};

struct SensorTrainerOptions {
    RegressorFamily family = RegressorFamily::network;
    int components = 3;  ///< of the mixture; tables and trees have 1
    int members = 4;     ///< learned with other blocks of time held out, whose mean is the result
    SensorHalfOptions reported = {.hidden = 8}, error = {};
    double roughness = 1e-5;  ///< of tables
    int trees = 10;           ///< of a member, for each output
    std::uint64_t seed = 1;
};

struct TrainedSensor {
    SensorNetwork network;
    bool cancelled = false;
};

/// Learns the distribution of readings. `blueprint` says all that is not learned here: sensor, what it measures and
/// reports, robots, period, latency, view. Runs in the caller's oneTBB arena; the same samples, options and seed give
/// the same network whatever the number of threads. Ended by `progress` between members: the best so far. Error: too
/// few looks or readings to learn from and to hold out.
Expected<TrainedSensor> trainSensor(const SensorNetwork& blueprint, const SensorSamples& samples,
                                    const SensorTrainerOptions& options, const Progress& progress = {});

}  // namespace mrose
