#include "behaviour/floor_plan.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace mrose {
namespace {

constexpr double nearEnough = 0.001;  // m, to the end of a free way

Point nearestOnSegment(const Point& place, const Point& a, const Point& b) {
    const Point along = b - a;
    return a + std::clamp(dot(place - a, along) / dot(along, along), 0.0, 1.0) * along;
}

FloorPlan::Wall wallTowards(const Point& place, const Point& nearest) {
    const double far = distance(nearest, place);
    return {nearest, far > 0 ? (1 / far) * (place - nearest) : Point{1, 0}, far};
}

/// nullopt: it is not nearer than `within`.
std::optional<FloorPlan::Wall> wallOf(const ConvexPiece& piece, const Point& place, double within) {
    if (piece.isCircle()) {
        const FloorPlan::Wall centre = wallTowards(place, piece.centre);
        if (centre.distance - piece.radius >= within) return std::nullopt;
        return FloorPlan::Wall{piece.centre + piece.radius * centre.away, centre.away, centre.distance - piece.radius};
    }
    FloorPlan::Wall inside{{}, {}, -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < piece.count; ++i)
        if (const double outside = dot(piece.normals[i], place - piece.corners[i]); outside > inside.distance) {
            if (outside >= within) return std::nullopt;  // nothing of it is nearer than that
            inside = {place - outside * piece.normals[i], piece.normals[i], outside};
        }
    if (inside.distance <= 0) return inside;
    FloorPlan::Wall best;
    best.distance = within;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point nearest = nearestOnSegment(place, piece.corners[i], piece.corners[piece.cornerAfter(i)]);
        if (const double far = distance(nearest, place); far < best.distance) best = wallTowards(place, nearest);
    }
    if (best.distance >= within) return std::nullopt;
    return best;
}

}  // namespace

std::vector<FloorPlan::Wall> FloorPlan::wallsNear(const Point& place, double within) const {
    std::vector<Wall> walls;
    for (const ConvexPiece& piece : pieces_) {
        if (distance(place, piece.centre) > piece.reach + within) continue;
        if (const auto wall = wallOf(piece, place, within)) walls.push_back(*wall);
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
