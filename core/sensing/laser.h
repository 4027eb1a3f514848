#pragma once

#include "control/sensor_records.h"
#include "sensing/beam_fan.h"
#include "sensing/element_sensor.h"
#include "sensing/range_errors.h"
#include "sensing/sensor_sources.h"

namespace mrose {

/// A laser scanner: NAME has a RangeEcho for each beam, all of one instant, in the order of their directions.
class Laser final : public ElementSensor {
public:
    static constexpr std::size_t mostBeams = 4096;

    struct Options {
        Pose mount;        ///< in the robot's frame
        double first = 0;  ///< rad, of the first beam, from the mount's heading
        double step = 1;   ///< rad, from beam to beam
        std::size_t beams = 1;
        RangeErrors errors;
        Nanoseconds latency = 0;
    };
    Laser(const SensorTraits& traits, const Options& options);

    std::vector<ReadingKind> gives() const override { return {{name(), &recordType<RangeEcho>()}}; }
    std::vector<SensorElement> elements() const override;
    std::vector<MemoryEntry> summary(const Observation& all, const Reading& reading) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    ReadingName reading_;
    Options options_;
    BeamFan fan_;
    Pose middle_;  ///< of the fan: where it is, facing its middle
    Outlines::Sector sector_;
    std::vector<RangeEcho> echoes_;  ///< as they are without any echo
};

SensorPointer readLaser(TomlTable& table, const SensorTraits& traits, const SensorSources& sources);

}  // namespace mrose
