#include "geometry/pose.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace mrose {
namespace {

/// sin(a)/a and (1 - cos(a))/a without cancellation near zero.
struct ArcFactors {
    double along, across;
};

ArcFactors arcFactors(double angle) {
    if (std::abs(angle) < 1e-4) return {1 - angle * angle / 6, angle / 2 * (1 - angle * angle / 12)};
    const double half = std::sin(angle / 2);
    return {std::sin(angle) / angle, 2 * half * half / angle};
}

}  // namespace

double wrapAngle(double radians) {
    constexpr double pi = std::numbers::pi;
    if (radians > -pi && radians <= pi) return radians;
    const double wrapped = std::remainder(radians, 2 * pi);
    return wrapped <= -pi ? wrapped + 2 * pi : wrapped;
}

Pose operator*(const Pose& aToB, const Pose& bToC) {
    const double c = std::cos(aToB.heading), s = std::sin(aToB.heading);
    return {aToB.x + c * bToC.x - s * bToC.y, aToB.y + s * bToC.x + c * bToC.y, aToB.heading + bToC.heading};
}

Pose inverse(const Pose& pose) {
    const double c = std::cos(pose.heading), s = std::sin(pose.heading);
    return {-c * pose.x - s * pose.y, s * pose.x - c * pose.y, -pose.heading};
}

Pose relative(const Pose& from, const Pose& to) {
    const double c = std::cos(from.heading), s = std::sin(from.heading);
    const double dx = to.x - from.x, dy = to.y - from.y;
    return {c * dx + s * dy, c * dy - s * dx, to.heading - from.heading};
}

Pose exp(const Twist& twist) {
    const auto [along, across] = arcFactors(twist.rotation);
    return {along * twist.x - across * twist.y, across * twist.x + along * twist.y, twist.rotation};
}

Twist log(const Pose& pose) {
    const auto [along, across] = arcFactors(pose.heading);
    const double squared = along * along + across * across;
    assert(squared > 1e-20 || (pose.x == 0 && pose.y == 0));
    if (squared <= 1e-20) return {0, 0, pose.heading};
    return {(along * pose.x + across * pose.y) / squared, (along * pose.y - across * pose.x) / squared, pose.heading};
}

}  // namespace mrose
