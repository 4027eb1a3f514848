#include "sensing/line_of_sight.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

/// A body that may hide others: within `reach` of `offset` from the observer.
struct Screen {
    double nearest;  ///< m from the observer, at least
    Point offset;
    double reach;
    std::size_t body;
};

/// Those nearer than `farthest`, nearest first: in a crowd the first ones already hide most.
std::vector<Screen> screensAround(const Observer& observer, std::int64_t lag, const Point& eye, double farthest) {
    const Scene& scene = observer.scenario.scene();
    std::vector<Screen> screens;
    screens.reserve(scene.bodyCount());
    for (std::size_t body = 0; body < scene.bodyCount(); ++body) {
        if (body == observer.robot) continue;
        const Point offset = position(observer.poseBefore(body, lag)) - eye;
        const double reach = scene.shapeOf(body).reach, nearest = length(offset) - reach;
        if (nearest < farthest) screens.push_back({nearest, offset, reach, body});
    }
    std::sort(screens.begin(), screens.end(), [](const Screen& a, const Screen& b) { return a.nearest < b.nearest; });
    return screens;
}

bool mayHide(const Screen& screen, const Point& line, double squaredLength) {
    const double across = cross(screen.offset, line);
    return across * across <= screen.reach * screen.reach * squaredLength &&
           (screen.nearest <= 0 || dot(screen.offset, line) > 0);
}

bool hiddenByBody(const Observer& observer, std::int64_t lag, const Point& eye, const Point& target, std::size_t body,
                  const std::vector<Screen>& screens) {
    const Point line = target - eye;
    const double squaredLength = dot(line, line), far = std::sqrt(squaredLength);
    for (const Screen& screen : screens) {
        if (screen.nearest >= far) return false;
        if (screen.body == body || !mayHide(screen, line, squaredLength)) continue;
        const Placement frame(observer.poseBefore(screen.body, lag));
        const Point from = frame.placeBack(eye), to = frame.placeBack(target);
        const std::vector<ConvexPiece>& pieces = observer.scenario.scene().shapeOf(screen.body).pieces;
        if (std::any_of(pieces.begin(), pieces.end(), [&](const ConvexPiece& p) { return crosses(p, from, to); }))
            return true;
    }
    return false;
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

void removeHidden(const Observer& observer, std::int64_t lag, std::size_t first, std::vector<SeenBody>& seen) {
    if (seen.empty()) return;
    const Point eye = position(observer.poseBefore(observer.robot, lag));
    double farthest = 0;
    for (const SeenBody& body : seen) farthest = std::max(farthest, length(body.position_B));
    const std::vector<Screen> screens = screensAround(observer, lag, eye, farthest);
    std::erase_if(seen, [&](const SeenBody& s) {
        const std::size_t body = first + s.index;
        const Point target = position(observer.poseBefore(body, lag));
        return hiddenByBody(observer, lag, eye, target, body, screens) ||
               hiddenByObstacle(observer.scenario.obstacles(), eye, target);
    });
}

}  // namespace mrose
