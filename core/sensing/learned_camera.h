#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "geometry/point.h"
#include "perception/learned_sensor.h"
#include "perception/reading_noise.h"
#include "scene/perception.h"
#include "sensing/learned_options.h"
#include "sensing/sensor.h"
#include "world/noise.h"

namespace mrose {

class SimulatedView;

/// A camera as it was learned from logs (perception/): it reports landmarks and robots, at its own period, as they were
/// its latency ago, with what logs say of readings that are missing, off, and off together. The readings NAME.landmarks
/// and NAME.robots hold SeenBody: the landmark's place in the environment's list, or the robot's number. A look at
/// which it reports nothing gives empty ones.
class LearnedCamera final : public Sensor {
public:
    static constexpr std::size_t mostName = 21;  ///< characters, for NAME.landmarks

    using Options = LearnedSensorOptions;
    /// The network is of subjects, not of poses. A period of 0 is the network's.
    LearnedCamera(std::shared_ptr<const LearnedSensor> learned, const SensorTraits& traits, const Options& options);
    LearnedCamera(std::shared_ptr<const LearnedSensor> learned, const SensorTraits& traits)
        : LearnedCamera(std::move(learned), traits, Options{}) {}

    static constexpr std::size_t channels = 3;  ///< whether it is reported, range, bearing

    /// Standard normal numbers that last.
    struct Memory {
        /// Of one subject.
        struct Slot {
            std::uint32_t owner = 0;  ///< subjects from 1, landmarks first, then robots; 0: nobody
            std::array<float, channels> parts{};
            Nanoseconds looked = 0;  ///< the last instant at which it was in view
        };
        Nanoseconds looked = 0;   ///< the last instant of measurement
        std::uint32_t begun = 0;  ///< 0 until the first
        std::array<float, channels> slow{};
        std::array<Slot, 32> slots{};  ///< a subject's is that of its number modulo 32, if it is free

        /// A subject's own; nullptr: it has none.
        Slot* find(std::uint32_t subject);
        /// One for a subject that has none: a free one, else that of the subject that was in view longest ago, the
        /// first of several. nullptr: all belong to subjects that are in view `now`.
        Slot* take(std::uint32_t subject, Nanoseconds now);
    };

    std::string name() const override { return traits_.name; }
    std::vector<ReadingKind> gives() const override;
    Nanoseconds period() const override { return traits_.period; }
    Nanoseconds latency() const override { return latency_; }
    bool exact() const override { return true; }
    Nanoseconds lookBack() const override { return latency_ + reach_; }
    const BodySight* sight() const override { return &sight_; }
    std::size_t memorySize() const override { return sizeof(Memory); }
    bool sound(std::span<const std::byte> memory) const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    using Channels = std::array<double, channels>;
    /// A subject's number for whether it is reported, and what is common to its errors' numbers and those of other
    /// looks.
    struct Numbers {
        double reported = 0;
        ReadingError errors{};
    };
    Channels commonNumbers(const SensorView& view, Memory& memory) const;
    Numbers numbersOf(const UniformDraws& draws, std::uint32_t subject, Nanoseconds now, const Channels& common,
                      Memory& memory) const;
    ReadingDraw errorDraw(const UniformDraws& draws, const ReadingError& common) const;
    int robotOf(const SensorView& view) const;
    bool reports(SubjectKind kind) const;

    std::shared_ptr<const LearnedSensor> learned_;
    SensorTraits traits_;
    std::optional<int> robot_;  ///< of the network's
    Nanoseconds latency_, reach_;
    BodySight sight_;
    NoiseWeights weights_;
    bool anySubject_ = false;                       ///< any part of the noise is a subject's
    std::array<Lasting, channels> slow_, subject_;  ///< after one period
    std::vector<ReadingKind> gives_;
};

}  // namespace mrose
