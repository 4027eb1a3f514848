#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "recording/mcap_writer.h"
#include "scenario/scenario.h"
#include "simulation/step.h"

namespace mrose {

/// What robots' own sensors gave in one branch, up to ten times a second: lasers as foxglove.LaserScan, sonars' and
/// infrared sensors' echoes as foxglove.PointCloud, all else as mrose.Reading.TYPE, a topic for each reading of a
/// robot.
class ReadingTopics {
public:
    /// A branch's; those of further robots are left out.
    static constexpr std::size_t most = 4000;

    struct Schemas {
        std::uint16_t laserScan = 0, pointCloud = 0;
    };
    static Schemas addSchemas(mcap::Writer& writer);

    /// `frames`: of all bodies, as topics and frames begin.
    ReadingTopics(mcap::Writer& writer, const Schemas& schemas, const Scenario& scenario,
                  std::span<const std::string> frames);

    /// Of a tick that ended at `time`.
    void add(mcap::Writer& writer, const StepTrace& trace, Nanoseconds time);

private:
    struct Topic {
        std::size_t robot;
        ReadingName reading;
        const Sensor* sensor;
        std::string frame;
        std::uint16_t channel;
        Nanoseconds sample = -1;  ///< the last that was written, in periods
    };

    std::vector<Topic> topics_;
};

}  // namespace mrose
