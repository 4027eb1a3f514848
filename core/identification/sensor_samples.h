#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "logs/robot_log.h"
#include "perception/logged_view.h"
#include "perception/reading_distribution.h"
#include "perception/sensor_network.h"

namespace mrose {

/// What one look of a sensor could report, and whether it did.
struct SensorCase {
    SensedState state;
    std::size_t subject = 0;  ///< in Log::subjects; 0 of a pose
    bool reported = false;
    ReadingError error{};  ///< where it was reported; of a pose in the robot's true frame
};

/// One look of a robot's sensor: its cases are `count` from `first` on.
struct SampledLook {
    std::size_t log = 0;  ///< of the logs
    int robot = -1;       ///< in SensorSamples::robots
    Nanoseconds time = 0;
    int block = 0;  ///< of time and of the trajectories' groups: what is held out together
    std::size_t first = 0, count = 0;
    bool unknown = false;  ///< the same as the one before, as if all other robots but one were not tracked
};

/// What the sensors of one name reported in logs, beside what was true.
struct SensorSamples {
    std::vector<std::string> robots;
    std::vector<SampledLook> looks;
    std::vector<SensorCase> cases;
    std::int64_t withoutTruth = 0;  ///< looks at which it is not known where the robot was: left out
    std::int64_t unknownPlace = 0;  ///< readings of subjects whose place is not known: left out
    std::int64_t outOfView = 0;     ///< readings of subjects that were far out of view: left out
    std::int64_t falseTruth = 0;    ///< looks at which the ground truth was off: left out

    std::size_t readings() const;
    /// Calls use(case) for each reading, once.
    template <class Use>
    void visitReadings(const Use& use) const {
        for (const SampledLook& look : looks)
            for (std::size_t i = look.first; i < look.first + look.count && !look.unknown; ++i)
                if (cases[i].reported) use(cases[i]);
    }
};

/// A stretch of a robot's trajectory over which its ground truth was off (SensorChange::Cause::truth).
struct FalseTruth {
    std::size_t log = 0, robot = 0, trajectory = 0;  ///< of the logs, of the log's, of the robot's
    Nanoseconds begin = 0, end = 0;                  ///< stamps of readings
};

struct SensorSampleOptions {
    std::string sensor;  ///< its name in the logs
    SensorNetwork::Measures measures = SensorNetwork::Measures::subjects;
    std::vector<std::string> robots = {};  ///< whose; empty: of all. The others are seen and occlude
    Nanoseconds latency = 0;               ///< from what is measured to the stamp
    /// Of a clock by which poses are reported: where they lie up to 50 periods apart, it reported none between them. 0:
    /// it has none.
    Nanoseconds period = 0;
    View view = {};                               ///< subjects within its margin are cases
    bool landmarks = true, robotSubjects = true;  ///< which kinds are
    std::vector<FalseTruth> falseTruth = {};      ///< looks at which nothing is learned
    TrackedSizes sizes = {};
    double block = 60;  ///< s
};

/// Without looks where the logs have none.
SensorSamples sensorSamples(std::span<const Log> logs, const SensorSampleOptions& options);

}  // namespace mrose
