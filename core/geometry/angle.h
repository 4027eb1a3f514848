#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/elementary.h"

namespace mrose {

/// As wrapAngle(), to the last bit up to two and a half turns, and without a division's remainder beyond: there it is
/// off by at most 2^-53 of `radians` and a half turn more, and may be as much outside of (-pi, pi]. For headings that
/// go through many turns, where what was learned depends on the last bit; elsewhere wrapAngle() is the one to take.
inline double wrapAngleNearly(double radians) {
    constexpr double turn = 2 * std::numbers::pi;
    const double wrapped = radians - turn * nearestWhole(radians / turn);
    return wrapped > -std::numbers::pi ? wrapped : wrapped + turn;
}

/// How far apart two directions in (-pi, pi] are, in [0, pi]: |wrapAngle(a - b)|, without a branch.
inline double angleBetween(double a, double b) {
    const double angle = std::abs(a - b);
    return std::min(angle, 2 * std::numbers::pi - angle);
}

}  // namespace mrose
