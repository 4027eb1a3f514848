#pragma once

#include <algorithm>
#include <utility>

#include "geometry/point.h"

namespace mrose {

/// Two corners of a box that holds the sector about `eye`'s x of half an angle, given by its cosine and sine, within
/// `reach`, and `pad` around it; m.
inline std::pair<Point, Point> boxOfSector(const Placement& eye, double halfCosine, double halfSine, double reach,
                                           double pad) {
    constexpr double rounding = 1e-9;
    Point least, most;
    const auto hold = [&](const Point& direction) {
        least = {std::min(least.x, direction.x), std::min(least.y, direction.y)};
        most = {std::max(most.x, direction.x), std::max(most.y, direction.y)};
    };
    hold(eye.rotate({halfCosine, halfSine}));
    hold(eye.rotate({halfCosine, -halfSine}));
    for (const Point& axis : {Point{1, 0}, Point{-1, 0}, Point{0, 1}, Point{0, -1}})
        if (eye.rotateBack(axis).x >= halfCosine - rounding) hold(axis);
    const double farther = reach * (1 + rounding);
    const Point around{pad, pad};
    return {eye.origin + farther * least - around, eye.origin + farther * most + around};
}

}  // namespace mrose
