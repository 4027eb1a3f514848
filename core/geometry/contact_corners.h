#pragma once

#include "geometry/polygon.h"

namespace mrose {

/// Contact takes corners nearer than this for one, and cuts edges in floats: what it is given is clear in floats of 0.1
/// m too.
struct ContactPrecision {
    static constexpr double unitsPerMetre = 10;
    static constexpr double weld =
        0.0003;  ///< m: corners are kept farther apart, a little more than Box2D's shapes ask
    static constexpr double height = 1e-5;  ///< m: and, of any three, no nearer to the line through two ...
    static constexpr double heightShare = 1.0 / (1 << 20);  ///< ... nor than this share of the longest side
    static constexpr double area = 1e-8;                    ///< m2: a piece is not smaller
};

/// The corners of a convex polygon (counter-clockwise) that the solver can tell apart, and any three of which turn left
/// to it: in its floats a side's direction errs by up to a fourth of `heightShare`. Empty where they make no polygon.
Polygon contactCorners(const Polygon& convex);

}  // namespace mrose
