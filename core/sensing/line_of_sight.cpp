#include "sensing/line_of_sight.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

double widestReach(const Scene& scene) {
    double widest = 0;
    for (const RobotType& type : scene.robotTypes) widest = std::max(widest, type.shape->reach);
    for (const ObjectType& type : scene.objectTypes) widest = std::max(widest, type.shape->reach);
    return widest;
}

/// A line from an eye to what it looks at.
struct SightLine {
    const SensorView& view;
    const BodyMap& map;
    Point eye, target, line;
    double squaredLength, length;

    SightLine(const SensorView& looking, const BodyMap& bodies, std::size_t body)
        : view(looking),
          map(bodies),
          eye(map.positions[view.robot]),
          target(map.positions[body]),
          line(target - eye),
          squaredLength(dot(line, line)),
          length(std::sqrt(squaredLength)) {}

    bool passesNear(const Point& offset, double reach) const {
        const double across = cross(offset, line);
        return across * across <= reach * reach * squaredLength;
    }
    bool hits(std::size_t body) const {
        const Shape& shape = view.scene.shapeOf(body);
        const Point offset = map.positions[body] - eye;
        const double nearest = mrose::length(offset) - shape.reach;
        if (nearest >= length || !passesNear(offset, shape.reach)) return false;
        if (nearest > 0 && dot(offset, line) <= 0) return false;  // behind
        const Placement frame(view.past.poseBefore(view.state, body, map.lag));
        const Point from = frame.placeBack(eye), to = frame.placeBack(target);
        return std::any_of(shape.pieces.begin(), shape.pieces.end(),
                           [&](const ConvexPiece& piece) { return crosses(piece, from, to); });
    }
};

bool hiddenByBody(const SightLine& sight, std::size_t body, double widest) {
    return sight.map.grid.anyAlong(sight.eye, sight.target, widest, [&](const PointGrid::Entry& entry) {
        return entry.number != sight.view.robot && entry.number != body &&
               sight.passesNear(entry.point - sight.eye, widest) && sight.hits(entry.number);
    });
}

bool hiddenByObstacle(const ObstacleIndex& obstacles, const Point& eye, const Point& target) {
    if (obstacles.pieces().empty()) return false;
    // Each point of the line is within the index's margin of one of these.
    const Point line = target - eye;
    const int parts = 1 + static_cast<int>(length(line) / (1.9 * obstacles.margin()));
    for (int i = 0; i < parts; ++i)
        for (const std::uint32_t piece : obstacles.near(eye + ((i + 0.5) / parts) * line))
            if (crosses(obstacles.pieces()[piece], eye, target)) return true;
    return false;
}

}  // namespace

bool crosses(const ConvexPiece& piece, const Point& from, const Point& to) {
    if (piece.isCircle()) return distanceToSegment(piece.corners[0], from, to) < piece.radius;
    double enters = 0, leaves = 1;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point& corner = piece.corners[i];
        const Point edge = piece.corners[(i + 1) % piece.count] - corner;
        // Inside of this edge where depth + t * change > 0.
        const double depth = cross(edge, from - corner), change = cross(edge, to - from);
        if (change == 0 && depth <= 0) return false;
        if (change > 0) enters = std::max(enters, -depth / change);
        if (change < 0) leaves = std::min(leaves, -depth / change);
        if (enters >= leaves) return false;
    }
    return true;
}

void removeHidden(const SensorView& view, const BodyMap& map, std::size_t first, std::vector<SeenBody>& seen) {
    if (seen.empty()) return;
    const double widest = widestReach(view.scene);
    std::erase_if(seen, [&](const SeenBody& s) {
        const SightLine sight(view, map, first + s.index);
        return hiddenByBody(sight, first + s.index, widest) ||
               hiddenByObstacle(view.obstacles, sight.eye, sight.target);
    });
}

}  // namespace mrose
