#pragma once

#include <span>
#include <vector>

#include "geometry/shape.h"

namespace mrose {

/// Convex pieces made ready for contact; one for all bodies of a shape.
struct CollisionShape {
    struct Piece {
        ConvexPiece outline;
        double turning;  ///< m: a point of it gets no farther from the body's centre of mass, but by its roundness
    };
    std::vector<Piece> pieces;

    /// `centre`: of mass, about which the pieces turn.
    explicit CollisionShape(std::span<const ConvexPiece> outlines, const Point& centre = {});
};

}  // namespace mrose
