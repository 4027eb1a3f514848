#pragma once

#include <cassert>
#include <cmath>
#include <numbers>

#include "geometry/elementary.h"

namespace mrose {

/// The angle in (-pi, pi] that differs from `radians` by whole turns.
inline double wrapAngle(double radians) {
    constexpr double pi = std::numbers::pi;
    if (radians > -pi && radians <= pi) return radians;
    const double wrapped = std::remainder(radians, 2 * pi);
    return wrapped <= -pi ? wrapped + 2 * pi : wrapped;
}

/// Position and heading of a frame in another one: metres, radians, x forward, y left, heading counter-clockwise.
/// Headings are not wrapped, so that a rotation through several turns keeps them.
struct Pose {
    double x = 0, y = 0, heading = 0;
    bool operator==(const Pose&) const = default;
};

/// The pose of C in A, given that of B in A and that of C in B.
inline Pose operator*(const Pose& aToB, const Pose& bToC) {
    const auto [s, c] = sineCosine(aToB.heading);
    return {aToB.x + c * bToC.x - s * bToC.y, aToB.y + s * bToC.x + c * bToC.y, aToB.heading + bToC.heading};
}

inline Pose inverse(const Pose& pose) {
    const auto [s, c] = sineCosine(pose.heading);
    return {-c * pose.x - s * pose.y, s * pose.x - c * pose.y, -pose.heading};
}

/// `to` as seen from `from`: inverse(from) * to.
inline Pose relative(const Pose& from, const Pose& to) {
    const auto [s, c] = sineCosine(from.heading);
    const double dx = to.x - from.x, dy = to.y - from.y;
    return {c * dx + s * dy, c * dy - s * dx, to.heading - from.heading};
}

/// A constant body velocity held for one unit of time: forward, left, counter-clockwise.
struct Twist {
    double x = 0, y = 0, rotation = 0;
    bool operator==(const Twist&) const = default;
};

/// sin(a)/a and (1 - cos(a))/a without cancellation near zero.
struct ArcFactors {
    double along, across;
    explicit ArcFactors(double angle) : along(1 - angle * angle / 6), across(angle / 2 * (1 - angle * angle / 12)) {
        if (std::abs(angle) < 1e-4) return;
        const auto [s, c] = sineCosine(angle / 2);
        along = 2 * s * c / angle;
        across = 2 * s * s / angle;
    }
};

/// SE(2) exponential: where constant `twist` leads in one unit of time. Exact to rounding for every rotation, also
/// tiny.
inline Pose exp(const Twist& twist) {
    const auto [along, across] = ArcFactors(twist.rotation);
    return {along * twist.x - across * twist.y, across * twist.x + along * twist.y, twist.rotation};
}

/// SE(2) logarithm, the inverse of exp. A heading beyond half a turn keeps its turns; headings at whole turns other
/// than zero have no logarithm unless the position is zero (asserted).
inline Twist log(const Pose& pose) {
    const auto [along, across] = ArcFactors(pose.heading);
    const double squared = along * along + across * across;
    assert(squared > 1e-20 || (pose.x == 0 && pose.y == 0));
    if (squared <= 1e-20) return {0, 0, pose.heading};
    return {(along * pose.x + across * pose.y) / squared, (along * pose.y - across * pose.x) / squared, pose.heading};
}

}  // namespace mrose
