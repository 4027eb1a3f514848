#pragma once

#include <span>

#include "geometry/point.h"

namespace mrose {

/// A rectangle on a page, y down, in pixels.
struct PageBox {
    double left = 0, top = 0, right = 0, bottom = 0;

    Point centre() const { return {(left + right) / 2, (top + bottom) / 2}; }
    bool holds(const Point& p) const { return p.x > left && p.x < right && p.y > top && p.y < bottom; }
    bool overlaps(const PageBox& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
};

/// The place of a label of this size beside `at`: within `frame` and off the labels that are `taken`, where that can
/// be, covering as few of the points in `avoided` as can be, and then as near as can be.
PageBox placeLabel(const Point& at, double width, double height, std::span<const Point> avoided,
                   std::span<const PageBox> taken, const PageBox& frame);

}  // namespace mrose
