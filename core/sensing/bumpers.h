#pragma once

#include <utility>

#include "control/sensor_records.h"
#include "sensing/sensor.h"
#include "sensing/sensor_sources.h"

namespace mrose {

/// Bumpers round a robot: NAME has a BumperContact for each segment of its outline, pressed where something touched the
/// robot in a tick since the measurement before.
class Bumpers final : public Sensor {
public:
    static constexpr std::size_t mostSegments = 64;

    /// Of the outline, seen from the reference point: counter-clockwise from `first`, which belongs to it, to `first` +
    /// `width`, which does not.
    struct Segment {
        double first = 0, width = 0;  ///< rad, width up to a whole turn
        bool holds(double bearing) const;
        double middle() const;
    };
    Bumpers(const SensorTraits& traits, std::vector<Segment> segments);

    /// What is remembered of a segment.
    struct Memory {
        static constexpr std::int64_t never = -(std::int64_t{1} << 62);
        std::int64_t pressed = never;  ///< the last tick in which it was
        std::uint64_t touches = 0;     ///< that have begun
    };

    std::string name() const override { return traits_.name; }
    std::vector<ReadingKind> gives() const override { return {{traits_.name, &recordType<BumperContact>()}}; }
    Nanoseconds period() const override { return traits_.period; }
    bool feelsTouches() const override { return true; }
    std::vector<SensorElement> elements() const override;
    std::vector<MemoryEntry> summary(const Observation& all, const Reading& reading) const override;
    std::size_t memorySize() const override { return segments_.size() * sizeof(Memory); }
    void start(std::span<std::byte> memory) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    SensorTraits traits_;
    std::vector<Segment> segments_;
};

SensorPointer readBumpers(TomlTable& table, const SensorTraits& traits, const SensorSources& sources);

}  // namespace mrose
