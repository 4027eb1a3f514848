#pragma once

#include "io/toml_table.h"
#include "scene/perception.h"
#include "sensing/sensor.h"

namespace mrose {

/// Where its robot is: the reading "self", one Pose in the world's frame. Where a measurement does not arrive, the last
/// one stays.
class SelfLocaliser final : public Sensor {
public:
    explicit SelfLocaliser(const SelfLocalisation& options) : options_(options) {}

    struct Memory {
        Pose bias;  ///< at present
        Pose self;  ///< measured last
        Nanoseconds measured = 0;
        std::uint64_t localised = 0;  ///< 0 until the first measurement
    };

    std::string name() const override { return "self"; }
    std::vector<ReadingKind> gives() const override { return {{selfReading, &recordType<Pose>()}}; }
    Nanoseconds latency() const override { return options_.latency; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    bool sound(std::span<const std::byte> memory) const override;
    std::vector<MemoryEntry> explain(std::span<const std::byte> memory) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    void driftBias(const SensorView& view, Memory& memory) const;
    void measure(const SensorView& view, Memory& memory) const;

    SelfLocalisation options_;
};

/// Its keys, [perception.self] of a robot file.
SelfLocalisation readSelfLocalisation(TomlTable table);

}  // namespace mrose
