#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>

#include <Eigen/Dense>

#include "geometry/point.h"

namespace mrose {

/// A tracked point at an instant, s from an origin of the caller's.
struct TrackedPoint {
    double time = 0;
    Point place;
};

/// A path of even acceleration, or of one until `change` and another one from then on, fitted to a track by least
/// squares.
struct PathFit {
    /// x, y; velocity at `begin`; acceleration; acceleration from `change` on; change, in s after `begin`.
    enum Parameter { place, velocity = 2, first = 4, second = 6, change = 8, count };
    using Parameters = std::array<double, count>;

    double begin = 0;
    bool changes = false;
    Parameters parameters{};
    Eigen::Matrix<double, count, count> covariance = Eigen::Matrix<double, count, count>::Zero();
    double residual = 0;  ///< m, root mean square by coordinate, for the parameters fitted

    Point placeAt(double time) const { return placeAt(parameters, time); }
    Point velocityAt(double time) const { return velocityAt(parameters, time); }
    Point placeAt(const Parameters& p, double time) const;
    Point velocityAt(const Parameters& p, double time) const;

    /// The standard error of a function of the parameters, by its gradient.
    double errorOf(const std::function<double(const Parameters&)>& value) const;
};

/// nullopt of fewer than four points. `noise`, m, standard deviation of a coordinate: errors are at least of that.
std::optional<PathFit> fitEvenPath(std::span<const TrackedPoint> points, double noise);

/// With the change that fits best; nullopt where two accelerations do not fit significantly better than one, or where
/// fewer than four points lie to either side.
std::optional<PathFit> fitChangingPath(std::span<const TrackedPoint> points, double noise);

}  // namespace mrose
