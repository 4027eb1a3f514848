#include "sensing/line_of_sight.h"

#include <algorithm>
#include <cmath>

namespace mrose {
bool crosses(const ConvexPiece& piece, const Point& from, const Point& to) {
    if (piece.isCircle()) return distanceToSegment(piece.corners[0], from, to) < piece.radius;
    double enters = 0, leaves = 1;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point& corner = piece.corners[i];
        const Point edge = piece.corners[(i + 1) % piece.count] - corner;
        // Inside of this edge where depth + t * change > 0.
        const double depth = cross(edge, from - corner), change = cross(edge, to - from);
        if (depth <= 0 && change <= -depth) return false;  // all of the line is outside of it
        if (change > 0) enters = std::max(enters, -depth / change);
        if (change < 0) leaves = std::min(leaves, -depth / change);
        if (enters >= leaves) return false;
    }
    return true;
}

bool SightLine::hits(std::size_t other) const {
    const Point offset = map_.positions[other] - eye_;
    if (!passesNear(offset, widest_)) return false;  // most, at less cost
    const Shape& shape = view_.scene.shapeOf(other);
    if (!passesNear(offset, shape.reach)) return false;
    const double nearest = length(offset) - shape.reach;
    if (nearest >= length_) return false;
    if (nearest > 0 && dot(offset, line_) <= 0) return false;  // behind
    const Placement frame(view_.past.poseBefore(view_.state, other, map_.lag));
    const Point from = frame.placeBack(eye_), to = frame.placeBack(target_);
    return std::any_of(shape.pieces.begin(), shape.pieces.end(),
                       [&](const ConvexPiece& piece) { return crosses(piece, from, to); });
}

bool SightLine::hitsBody() const {
    return map_.grid.anyAlong(eye_, target_, widest_, [&](const PointGrid::Entry& entry) {
        return entry.number != view_.robot && entry.number != body_ && hits(entry.number);
    });
}

bool SightLine::hitsObstacle() const {
    const ObstacleIndex& obstacles = view_.obstacles;
    if (obstacles.pieces().empty()) return false;
    const auto hit = [&](const ConvexPiece& piece) { return crosses(piece, eye_, target_); };
    // Each point of the line is within the index's margin of one of so many.
    const int parts = 1 + static_cast<int>(length_ / (1.9 * obstacles.margin()));
    if (obstacles.pieces().size() <= static_cast<std::size_t>(parts)) {
        const Point least{std::min(eye_.x, target_.x), std::min(eye_.y, target_.y)};
        const Point most{std::max(eye_.x, target_.x), std::max(eye_.y, target_.y)};
        bool any = false;
        obstacles.visitBox(least, most, [&](std::uint32_t piece) { any = any || hit(obstacles.pieces()[piece]); });
        return any;
    }
    for (int i = 0; i < parts; ++i)
        for (const std::uint32_t piece : obstacles.near(eye_ + ((i + 0.5) / parts) * line_))
            if (hit(obstacles.pieces()[piece])) return true;
    return false;
}

}  // namespace mrose
