#include "behaviour/floor_plan.h"

#include <algorithm>

namespace mrose {
namespace {

constexpr double nearEnough = 0.001;  // m, to the end of a free way

}  // namespace

std::vector<FloorPlan::Wall> FloorPlan::wallsNear(const Point& place, double within) const {
    std::vector<Wall> walls;
    for (const ConvexPiece& piece : pieces_) {
        if (distance(place, piece.centre) > piece.reach + within) continue;
        if (leastDistance(piece, place) >= within) continue;
        if (const Wall wall = nearestPoint(piece, place); wall.distance < within) walls.push_back(wall);
    }
    return walls;
}

/// Distance to a convex piece is convex along the way: its slope here gives how far it is free at least.
double FloorPlan::freeWay(const Point& place, const Point& direction, double radius, double most) const {
    double way = 0;
    while (way < most) {
        double step = most - way;
        for (const Wall& wall : wallsNear(place + way * direction, step + radius))
            if (const double closing = -dot(direction, wall.away); closing > 0)
                step = std::min(step, std::max(0.0, wall.distance - radius) / closing);
        way += step;
        if (step < nearEnough) break;
    }
    return std::min(way, most);
}

}  // namespace mrose
