#pragma once

#include <optional>

#include "io/toml_table.h"
#include "scene/perception.h"
#include "sensing/sensor.h"
#include "world/noise.h"

namespace mrose {

/// Where its robot is: one Pose in the world's frame. Where a measurement does not arrive, the last one stays.
class SelfLocaliser final : public Sensor {
public:
    /// The one that every robot has: the reading "self".
    explicit SelfLocaliser(const SelfLocalisation& options) : options_(options), reading_(selfReading) {}
    /// A further one; its reading has its name.
    SelfLocaliser(const SelfLocalisation& options, const SensorTraits& traits)
        : options_(options), reading_(traits.name), traits_(traits) {}

    struct Memory {
        Pose bias;  ///< at present
        Pose self;  ///< measured last
        Nanoseconds measured = 0;
        std::uint64_t localised = 0;  ///< 0 until the first measurement
    };

    std::string name() const override { return std::string(reading_); }
    std::vector<ReadingKind> gives() const override { return {{reading_, &recordType<Pose>()}}; }
    Nanoseconds period() const override { return traits_ ? traits_->period : 0; }
    Nanoseconds latency() const override { return options_.latency; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    bool sound(std::span<const std::byte> memory) const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    NoiseKey keyOf(const SensorView& view, std::uint32_t part) const;
    void driftBias(const SensorView& view, double heading, Memory& memory) const;
    void measure(const SensorView& view, double heading, Memory& memory) const;

    SelfLocalisation options_;
    ReadingName reading_;
    std::optional<SensorTraits> traits_;  ///< of a further one
};

/// Its keys, [perception.self] of a robot file; whoever reads them rejects unknown ones.
SelfLocalisation readSelfLocalisation(TomlTable& table);

}  // namespace mrose
