#pragma once

#include <vector>

#include "sensing/outlines.h"

namespace mrose {

/// What an element that sends out a cone has before it, exactly: each outline as the arc of directions in which it
/// lies, counted from the cone's axis, with what is before what. Kept from element to element for its memory.
class ConeView {
public:
    /// Looks from a pose in the outlines' frame. `halfWidth`: rad, at most a quarter turn. What the element is inside
    /// of is not met.
    void look(const Outlines& outlines, const Pose& element, double halfWidth);

    /// Of the nearest visible point at which a surface sends back what meets it: whose normal is at most `limit` rad
    /// away from the direction to the element; m, infinite: there is none.
    double nearestEcho(double limit) const;

    /// What a ray meets.
    struct Hit {
        double range;      ///< m; infinite: nothing
        double incidence;  ///< cosine of the angle between the ray and the surface's normal
    };
    Hit along(double direction) const;

private:
    /// An edge, or a circle's near side.
    struct Arc {
        double least = 0, most = 0;  ///< rad, within the cone
        double facing = 0;           ///< rad: where its normal points at the element, the nearest point if it is there
        double distance = 0;         ///< m, of the edge's line, or of the circle's centre
        double radius = 0;           ///< m; 0: an edge

        double range(double direction) const;
        double incidence(double direction) const;
        /// How far from `facing` its normal is within `limit`.
        double reflects(double limit) const;
    };
    void add(Arc arc, double halfWidth);
    static bool hides(const Arc& other, const Arc& arc, double direction);
    double visibleFrom(const Arc& arc, double start, double step) const;

    std::vector<Arc> arcs_;
};

}  // namespace mrose
