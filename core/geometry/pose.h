#pragma once

namespace mrose {

/// The angle in (-pi, pi] that differs from `radians` by whole turns.
double wrapAngle(double radians);

/// Position and heading of a frame in another one: metres, radians, x forward, y left, heading counter-clockwise.
/// Headings are not wrapped, so that a rotation through several turns keeps them.
struct Pose {
    double x = 0, y = 0, heading = 0;
    bool operator==(const Pose&) const = default;
};

/// The pose of C in A, given that of B in A and that of C in B.
Pose operator*(const Pose& aToB, const Pose& bToC);
Pose inverse(const Pose& pose);

/// `to` as seen from `from`: inverse(from) * to.
Pose relative(const Pose& from, const Pose& to);

/// A constant body velocity held for one unit of time: forward, left, counter-clockwise.
struct Twist {
    double x = 0, y = 0, rotation = 0;
    bool operator==(const Twist&) const = default;
};

/// SE(2) exponential: where constant `twist` leads in one unit of time. Exact to rounding for every rotation, also
/// tiny.
Pose exp(const Twist& twist);

/// SE(2) logarithm, the inverse of exp. A heading beyond half a turn keeps its turns; headings at whole turns other
/// than zero have no logarithm unless the position is zero (asserted).
Twist log(const Pose& pose);

}  // namespace mrose
