#pragma once

#include "geometry/shape.h"

namespace mrose {

/// The point of a convex piece that is nearest to some place; within the piece, of its outline.
struct NearestPoint {
    Point nearest;
    Point away;           ///< from there to the place, or within the piece on to the outline; length 1
    double distance = 0;  ///< m; negative inside
};
NearestPoint nearestPoint(const ConvexPiece& piece, const Point& place);

/// How far a place is from a piece at least, m, quickly: how far outside of an edge's line it lies; negative within it.
double leastDistance(const ConvexPiece& piece, const Point& place);

/// The distance between a piece and the straight way from a to b, m; 0 where the way enters it.
double distanceToWay(const ConvexPiece& piece, const Point& a, const Point& b);

}  // namespace mrose
