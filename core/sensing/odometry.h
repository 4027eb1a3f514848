#pragma once

#include "sensing/sensor.h"

namespace mrose {

/// How fast its robot moves: the reading "odometry", one Velocity.
class Odometry final : public Sensor {
public:
    /// Standard deviations: m/s, rad/s.
    Odometry(double velocityNoise, double rotationNoise)
        : velocityNoise_(velocityNoise), rotationNoise_(rotationNoise) {}

    std::string name() const override { return "odometry"; }
    std::vector<ReadingKind> gives() const override { return {{odometryReading, &recordType<Velocity>()}}; }
    void sense(const SensorView& view, std::span<std::byte> memory, Observation& out) const override;

private:
    double velocityNoise_, rotationNoise_;
};

}  // namespace mrose
