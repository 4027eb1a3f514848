#pragma once

#include <optional>

#include "io/toml_table.h"
#include "scene/perception.h"
#include "sensing/sensor.h"

namespace mrose {

/// What a camera sees of other bodies: SeenBody in the order of their indices, as they were at its latency ago, in the
/// robot's own frame of then. The one that every robot has gives the readings "robots" and "objects", a further one
/// NAME.robots and NAME.objects.
class BodySensor final : public Sensor {
public:
    /// `biasTime`: s, the correlation time of the bias that both kinds of bodies are seen with.
    BodySensor(const BodySight& robots, const BodySight& objects, double biasTime,
               std::optional<SensorTraits> traits = std::nullopt);

    struct Memory {
        double bearingBias = 0;  ///< in standard deviations
        std::uint64_t unused = 0;
    };

    std::string name() const override { return traits_ ? traits_->name : "sight"; }
    Nanoseconds period() const override { return traits_ ? traits_->period : 0; }
    std::vector<ReadingKind> gives() const override;
    Nanoseconds latency() const override { return std::max(robots_.latency, objects_.latency); }
    const BodySight* sight() const override { return &robots_; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    bool sound(std::span<const std::byte> memory) const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    BodySight robots_, objects_;
    double biasTime_;
    std::optional<SensorTraits> traits_;
    ReadingName robotsReading_, objectsReading_;
};

/// Of these keys the ones that say where it looks, how late, and whether anything hides bodies.
BodySight readSightField(TomlTable& table);
/// Its keys, [perception.robots] and [perception.objects] of a robot file; whoever reads them rejects unknown ones.
BodySight readBodySight(TomlTable& table);

}  // namespace mrose
