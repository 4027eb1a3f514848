#pragma once

#include <vector>

#include "geometry/nearest_point.h"

namespace mrose {

/// What stands still around a robot, as far as it knows: convex pieces in the world's frame. Robots, balls and boxes
/// are not in it.
class FloorPlan {
public:
    using Wall = NearestPoint;

    explicit FloorPlan(std::vector<ConvexPiece> pieces = {}) : pieces_(std::move(pieces)) {}

    const std::vector<ConvexPiece>& pieces() const { return pieces_; }
    /// Of each piece nearer than `within`.
    std::vector<Wall> wallsNear(const Point& place, double within) const;
    /// How far a disc of `radius` gets from `place` in `direction` (length 1) until it touches a wall that it comes
    /// nearer to; at most `most`, m.
    double freeWay(const Point& place, const Point& direction, double radius, double most) const;

private:
    std::vector<ConvexPiece> pieces_;
};

}  // namespace mrose
