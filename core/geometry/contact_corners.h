#pragma once

#include "geometry/polygon.h"

namespace mrose {

/// What contact tells apart: finer than it matters, and so coarse that rounding never turns a polygon inside out.
struct ContactPrecision {
    static constexpr double weld = 0.0003;  ///< m: corners are farther from each other ...
    static constexpr double height = 1e-5;  ///< m: and, of any three, farther from the line through two ...
    static constexpr double heightShare = 1.0 / (1 << 20);  ///< ... and than this share of the longest side
    static constexpr double area = 1e-8;                    ///< m2: a piece is not smaller
};

/// The corners of a convex polygon (counter-clockwise) that contact tells apart, any three of which clearly turn left.
/// Empty where they make no polygon.
Polygon contactCorners(const Polygon& convex);

}  // namespace mrose
