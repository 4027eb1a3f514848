#pragma once

#include <tuple>

namespace mrose {

/// What a model's prediction leaves out, as standard deviations per period: the odometry model of Thrun, Burgard, Fox
/// (2005), 5.4, without its third rotation.
struct MotionNoise {
    double distancePerDistance = 0;  ///< m/m
    double rotationPerRotation = 0;  ///< rad/rad
    double rotationPerDistance = 0;  ///< rad/m
    bool operator==(const MotionNoise&) const = default;
    bool operator<(const MotionNoise& other) const { return numbers() < other.numbers(); }
    std::tuple<double, double, double> numbers() const {
        return {distancePerDistance, rotationPerRotation, rotationPerDistance};
    }

    bool none() const { return *this == MotionNoise{}; }
};

}  // namespace mrose
