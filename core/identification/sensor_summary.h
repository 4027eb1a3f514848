#pragma once

#include <span>
#include <string>
#include <vector>

#include "identification/sensor_lateness.h"
#include "identification/sensor_samples.h"
#include "logs/robot_log.h"

namespace mrose {

/// What the sensors of one name reported in logs, and when, by all robots and logs together.
struct SensorSummary {
    std::size_t readings = 0, poses = 0, scans = 0;
    std::size_t known = 0, gross = 0;  ///< readings beside ground truth; those that are gross errors
    std::size_t strayPoses = 0;        ///< of robots whose poses do not follow the true motion
    double followed = 0;               ///< the share of it that these follow, in the mean
    bool clocked = false;              ///< reports come regularly, so that a missing one shows
    Nanoseconds period = 0;            ///< of the clock, or else the median of the robots' medians; 0: of too few
    /// The robots' mean, weighted by their standard errors. Not identified: none is, for the reason of the first.
    SensorLateness lateness;
    std::vector<FalseTruth> falseTruth;
};

/// `robots`: whose; empty: of all.
SensorSummary summariseSensor(std::span<const Log> logs, const std::string& sensor,
                              const std::vector<std::string>& robots);

/// The mean of those that are identified. Its error grows with how far they disagree.
SensorLateness pooledLateness(std::span<const SensorLateness> each);

}  // namespace mrose
