#pragma once

#include "control/sensor_records.h"
#include "sensing/sensor.h"
#include "sensing/sensor_sources.h"

namespace mrose {

/// Encoders on the two wheels of a differential drive. NAME has the WheelTicks counted since the run's start; NAME.pose
/// is the Pose that they lead to, as seen from where the robot started. A robot that is pushed sideways turns no wheel.
class WheelEncoders final : public Sensor {
public:
    struct Options {
        double ticksPerMetre = 1000;
        double track = 0.3;  ///< m, between the wheels
        double slip = 0;     ///< m, standard deviation of a wheel's way after 1 m; it grows with the root of the way
    };
    WheelEncoders(const SensorTraits& traits, const Options& options);

    struct Memory {
        std::uint64_t begun = 0;     ///< 0 until the first measurement
        Pose last;                   ///< where the robot was at the measurement before
        double left = 0, right = 0;  ///< m, that the wheels have turned
        Pose reckoned;               ///< by whole ticks, from the start on
    };

    std::string name() const override { return traits_.name; }
    std::vector<ReadingKind> gives() const override;
    Nanoseconds period() const override { return traits_.period; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    bool sound(std::span<const std::byte> memory) const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    WheelTicks ticksOf(const Memory& memory) const;

    SensorTraits traits_;
    Options options_;
    ReadingName poseReading_;
};

SensorPointer readWheelEncoders(TomlTable& table, const SensorTraits& traits, const SensorSources& sources);

}  // namespace mrose
