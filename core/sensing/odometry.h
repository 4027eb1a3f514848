#pragma once

#include <optional>
#include <utility>

#include "sensing/sensor.h"

namespace mrose {

/// How fast its robot moves: one Velocity. The one that every robot has gives the reading "odometry", a further one its
/// name.
class Odometry final : public Sensor {
public:
    /// Standard deviations: m/s, rad/s.
    Odometry(double velocityNoise, double rotationNoise, std::optional<SensorTraits> traits = std::nullopt)
        : velocityNoise_(velocityNoise),
          rotationNoise_(rotationNoise),
          reading_(traits ? ReadingName(traits->name) : odometryReading),
          traits_(std::move(traits)) {}

    std::string name() const override { return std::string(reading_); }
    std::vector<ReadingKind> gives() const override { return {{reading_, &recordType<Velocity>()}}; }
    Nanoseconds period() const override { return traits_ ? traits_->period : 0; }
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    double velocityNoise_, rotationNoise_;
    ReadingName reading_;
    std::optional<SensorTraits> traits_;
};

}  // namespace mrose
