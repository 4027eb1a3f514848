#pragma once

#include "scene/perception.h"
#include "sensing/sensor.h"
#include "synthetic/reference_localiser.h"
#include "synthetic/world_landmarks.h"

namespace mrose {

/// Where its robot is, as the reference localiser (reference_localiser.h) says at its control instants: the reading
/// "self" of a robot with [perception] model = "reference". Where a report is missing, the last one stays. Synthetic.
class ReferenceSelf final : public Sensor {
public:
    /// Of `options` its latency counts. `scale`: of all errors but gross ones and misses.
    ReferenceSelf(const SelfLocalisation& options, double scale, WorldLandmarks landmarks,
                  const ReferenceLocaliserParameters& parameters = {});

    struct Memory {
        Pose belief;  ///< less the truth: what lasts of its error
        Pose truth;   ///< where the robot was at the measurement before
        Pose self;    ///< reported last
        Nanoseconds measured = 0;
        std::uint64_t begun = 0, within = 0, localised = 0;  ///< measured; in a burst of misses; reported: 1
    };
    static_assert(sizeof(Memory) == 104);

    std::string name() const override { return std::string(selfReading); }
    std::vector<ReadingKind> gives() const override { return {{selfReading, &recordType<Pose>()}}; }
    Nanoseconds latency() const override { return latency_; }
    Nanoseconds lookBack() const override { return latency_ + fromSeconds(p_.latencyJitter); }
    std::size_t memorySize() const override { return sizeof(Memory); }
    bool sound(std::span<const std::byte> memory) const override;
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override;
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    Nanoseconds latency_;
    double scale_;
    WorldLandmarks landmarks_;
    ReferenceLocaliserParameters p_;
};

}  // namespace mrose
