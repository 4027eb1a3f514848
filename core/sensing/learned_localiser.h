#pragma once

#include <memory>
#include <optional>
#include <string>

#include "perception/learned_sensor.h"
#include "sensing/learned_options.h"
#include "sensing/sensor.h"

namespace mrose {

/// Where its robot is, as a learned sensor says: at its own period, one Pose in the world's frame as it was its latency
/// ago, or none where it reports none.
class LearnedLocaliser final : public Sensor {
public:
    using Options = LearnedSensorOptions;
    /// `learned` measures poses. A period of 0 is the network's.
    LearnedLocaliser(std::shared_ptr<const LearnedSensor> learned, const SensorTraits& traits, const Options& options);

    struct Memory {
        ChannelNumbers slow{};    ///< what lasts of each channel's number: standard normal
        std::uint64_t begun = 0;  ///< 0 until the first look
    };

    std::string name() const override { return traits_.name; }
    std::vector<ReadingKind> gives() const override { return {{traits_.name, &recordType<Pose>()}}; }
    Nanoseconds period() const override { return traits_.period; }
    Nanoseconds latency() const override { return latency_; }
    bool exact() const override { return true; }
    Nanoseconds lookBack() const override { return latency_ + reach_; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    bool sound(std::span<const std::byte> memory) const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    std::size_t channels() const { return 1 + static_cast<std::size_t>(learned_->network().form.dimensions); }
    void carryOn(const SensorView& view, Memory& memory) const;
    ReadingDraw drawOf(const SensorView& view, const Memory& memory) const;

    std::shared_ptr<const LearnedSensor> learned_;
    SensorTraits traits_;
    std::optional<int> robot_;  ///< of the network's
    Nanoseconds latency_, reach_;
    NoiseWeights weights_;
};

}  // namespace mrose
