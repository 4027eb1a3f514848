#pragma once

#include "control/sensor_records.h"
#include "sensing/element_sensor.h"
#include "sensing/sensor_sources.h"

namespace mrose {

/// Infrared proximity sensors: NAME has an InfraredEcho for each. What comes back of an element's light is the mean
/// over its beam of (reference / range)^2 times the cosine of the angle at which it meets the surface, at most 1; light
/// of the surroundings is added, and noise.
class InfraredRing final : public ElementSensor {
public:
    static constexpr std::size_t mostElements = 64;

    struct Options {
        std::vector<Pose> elements;  ///< in the robot's frame, x along the axis
        double beam = 0;             ///< rad, full width
        double range = 0;            ///< m: nothing comes back from farther away
        double reference = 0;        ///< m, the range at which a surface that faces the element gives 1
        double ambient = 0;          ///< intensity of the surroundings' light
        double noise = 0;            ///< standard deviation of the intensity
        Nanoseconds latency = 0;
    };
    InfraredRing(const SensorTraits& traits, const Options& options);

    const Options& options() const { return options_; }

    std::vector<ReadingKind> gives() const override { return {{name(), &recordType<InfraredEcho>()}}; }
    std::vector<SensorElement> elements() const override;
    std::vector<MemoryEntry> summary(const Observation& all, const Reading& reading) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    double returned(const SensorView& view, const Pose& element) const;

    ReadingName reading_;
    Options options_;
    double farthest_ = 0;  ///< m, of what an element can reach from the robot's reference point
};

SensorPointer readInfraredRing(TomlTable& table, const SensorTraits& traits, const SensorSources& sources);

}  // namespace mrose
