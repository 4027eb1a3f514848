#pragma once

#include "control/sensor_records.h"
#include "sensing/element_sensor.h"
#include "sensing/range_errors.h"
#include "sensing/sensor_sources.h"

namespace mrose {

/// Sonars: NAME has a RangeEcho for each, that of the nearest visible point in its cone at which a surface sends sound
/// back.
class SonarRing final : public ElementSensor {
public:
    static constexpr std::size_t mostSonars = 64;

    struct Options {
        std::vector<Pose> sonars;  ///< in the robot's frame, x along the axis
        double cone = 0;           ///< rad, of the full cone
        double reflection = 0;  ///< rad: a surface whose normal is farther from the sound's direction sends none back
        double crossTalk = 0;   ///< probability that a sonar also hears the nearer echo of those beside it
        RangeErrors errors;
        Nanoseconds latency = 0;
    };
    SonarRing(const SensorTraits& traits, const Options& options);

    std::vector<ReadingKind> gives() const override { return {{name(), &recordType<RangeEcho>()}}; }
    std::vector<SensorElement> elements() const override;
    std::vector<MemoryEntry> summary(const Observation& all, const Reading& reading) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    void hearNeighbours(const SensorView& view, std::span<double> ranges) const;

    ReadingName reading_;
    Options options_;
    double farthest_ = 0;  ///< m, of what a sonar can reach from the robot's reference point
};

SensorPointer readSonarRing(TomlTable& table, const SensorTraits& traits, const SensorSources& sources);

}  // namespace mrose
