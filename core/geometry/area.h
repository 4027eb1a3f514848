#pragma once

#include "geometry/point.h"

namespace mrose {

/// A rectangle of the plane, in metres. One whose corners are the wrong way round is empty.
struct Area {
    Point least, most;

    bool empty() const { return most.x < least.x || most.y < least.y; }
    Point middle() const { return 0.5 * (least + most); }
    void include(const Point& point, double reach = 0);
    void include(const Area& other);
};

}  // namespace mrose
