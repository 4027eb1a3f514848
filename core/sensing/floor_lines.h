#pragma once

#include <vector>

#include "scene/environment.h"

namespace mrose {

/// The markings of the floor in a sensor's frame, as far as its sight meets the floor near them. Kept from measurement
/// to measurement for its memory.
class FloorLines {
public:
    /// Gathers at least all that come between two distances from the frame's origin, m; the frame is given in the
    /// world's.
    void find(const Environment& environment, const Placement& frame, double nearest, double farthest);
    /// Whether a point within these distances is on a marking: not farther from its line than half its width.
    bool hold(const Point& point) const;

private:
    struct Stroke {
        Point from, along;        ///< along: to its other end
        double perSquare = 0;     ///< 1 / its length squared
        double squaredReach = 0;  ///< half its width, squared
    };
    struct Ring {
        Point centre;
        double radius = 0, reach = 0;
    };
    void addStroke(const Point& from, const Point& to, double width);

    double nearest_ = 0, farthest_ = 0;
    std::vector<Stroke> strokes_;
    std::vector<Ring> rings_;
};

}  // namespace mrose
