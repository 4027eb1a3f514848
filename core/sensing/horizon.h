#pragma once

#include <vector>

#include "geometry/point.h"

namespace mrose {

/// How far a sensor can see at most, direction by direction, as far as is certain: beyond that is occluded. For leaving
/// out early what is out of view or hidden by what is nearer; what is not reported occluded may be hidden all the same.
class Horizon {
public:
    /// A sensor whose field of view lies between `edge_B` and its mirror image (any length; x forward), and ends at
    /// `range` m. `allRound`: there is no edge.
    void open(const Placement& eye, const Point& edge_B, bool allRound, double range);

    /// A disc, which hides what is behind it. `rounding`: m, by which coordinates may be off.
    void shade(const Point& centre, double radius, double rounding);

    /// Whether nothing can be seen there.
    bool occluded(const Point& point) const;
    /// In a whole box; its corners may be infinite.
    bool occluded(const Point& least, const Point& most) const;

private:
    double slotOf(double turn) const { return (turn + view_) * slotsPerTurn_; }
    std::size_t slotIn(double slot) const;

    Placement eye_;
    double view_ = 2, slotsPerTurn_ = 1;
    std::vector<float> ends_;  ///< m, by direction, from the view's right edge to its left
};

}  // namespace mrose
