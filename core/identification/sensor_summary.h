#pragma once

#include <span>
#include <string>
#include <vector>

#include "identification/sensor_inspection.h"
#include "identification/sensor_lateness.h"
#include "identification/sensor_samples.h"
#include "logs/robot_log.h"

namespace mrose {

/// What a robot's sensor reported in one of some logs.
struct InspectedSensor {
    std::size_t log = 0, robot = 0;  ///< of the logs, of the log's
    SensorInspection found;
};

/// What the sensors of one name reported in logs, and when, by all robots and logs together.
struct SensorSummary {
    std::vector<InspectedSensor> each;  ///< of those that reported anything
    std::size_t readings = 0, poses = 0, scans = 0;
    bool clocked = false;    ///< reports come regularly, so that a missing one shows
    Nanoseconds period = 0;  ///< of the clock, or else the median of the robots' medians; 0: of too few
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
