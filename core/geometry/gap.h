#pragma once

#include "geometry/shape.h"

namespace mrose {

/// How two convex pieces in one frame lie to each other, exact to a nanometre.
struct Gap {
    double distance = 0;  ///< m; negative where they overlap: the least depth along an edge's normal
    Point axis;           ///< from the first to the second where they are nearest, length 1
    Point at;             ///< the nearest point of the first (the deepest, where they overlap)
    /// Whose edge the axis is a normal of; none: a corner or a circle lies nearest to another.
    enum class Edge : std::uint8_t { none, ofFirst, ofSecond } edge = Edge::none;
    std::uint8_t edgeNumber = 0, corner = 0;  ///< of that edge, and of the other's corner nearest to it
};
Gap gapBetween(const ConvexPiece& a, const ConvexPiece& b);

}  // namespace mrose
