#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/point.h"

namespace mrose {

/// The angle of a vector in (-pi, pi], counter-clockwise from x; 0 for no vector. Error below 1e-15, and, unlike the C
/// library's, the same bits on every processor.
inline double direction(const Point& vector) {
    constexpr double pi = std::numbers::pi, tangentOfPi8 = 0.41421356237309503;
    const double x = std::abs(vector.x), y = std::abs(vector.y), longer = std::max(x, y);
    if (longer == 0) return 0;
    const double tangent = std::min(x, y) / longer;
    const bool wide = tangent > tangentOfPi8;
    const double t = wide ? (tangent - 1) / (tangent + 1) : tangent, z = t * t;
    // atan(t) / t, interpolated at Chebyshev nodes of t^2.
    double p = -0.025316479573776477;
    p = p * z + 0.05024762118940128;
    p = p * z + -0.0650598296717084;
    p = p * z + 0.07673535428183285;
    p = p * z + -0.09089529956562307;
    p = p * z + 0.11111048853751296;
    p = p * z + -0.14285712661684793;
    p = p * z + 0.19999999978392663;
    p = p * z + -0.3333333333322143;
    p = p * z + 0.999999999999999;
    double angle = p * t + (wide ? pi / 4 : 0);
    if (y > x) angle = pi / 2 - angle;
    if (vector.x < 0) angle = pi - angle;
    return vector.y < 0 ? -angle : angle;
}

}  // namespace mrose
