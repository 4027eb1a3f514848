#pragma once

#include <vector>

#include "geometry/point.h"

namespace mrose {

/// How far an eye can see at most, direction by direction, as far as is certain: where it ends is dark. For leaving out
/// early what is out of view or hidden by what is nearer; what is not dark may be hidden all the same.
class Horizon {
public:
    /// An eye whose view has its half at `edge_B` and its mirror image (any length; x forward), and ends at `range` m.
    /// `allRound`: there is no edge.
    void open(const Placement& eye, const Point& edge_B, bool allRound, double range);

    /// A disc, which nobody sees through. `rounding`: m, by which coordinates may be off.
    void shade(const Point& centre, double radius, double rounding);

    /// Whether nothing is to be seen there.
    bool dark(const Point& point) const;
    /// In a whole box; its corners may be infinite.
    bool dark(const Point& least, const Point& most) const;

private:
    double slotOf(double turn) const { return (turn + view_) * slotsPerTurn_; }
    std::size_t slotIn(double slot) const;

    Placement eye_;
    double view_ = 2, slotsPerTurn_ = 1;
    std::vector<float> ends_;  ///< m, by direction, from the view's right edge to its left
};

}  // namespace mrose
