#include "scenario/start_check.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace mrose {
namespace {

/// A convex piece in its place, and whose it is.
struct Item {
    ConvexPiece piece;
    std::size_t owner = 0;  ///< a body, or the number of bodies and an obstacle
    double begin = 0, end = 0;
};

void add(std::vector<Item>& items, const ConvexPiece& piece, std::size_t owner) {
    items.push_back({piece, owner, piece.centre.x - piece.reach, piece.centre.x + piece.reach});
}

const Pose& startPoseOf(const Scene& scene, std::size_t body) {
    return body < scene.robots.size() ? scene.robots[body].start : scene.objects[body - scene.robots.size()].start;
}

std::vector<Item> itemsOf(const Scene& scene) {
    std::vector<Item> items;
    const std::size_t bodies = scene.bodyCount();
    for (std::size_t body = 0; body < bodies; ++body) {
        const Placement placement(startPoseOf(scene, body));
        for (const ConvexPiece& piece : scene.shapeOf(body).pieces) add(items, placed(piece, placement), body);
    }
    for (std::size_t i = 0; i < scene.environment.obstacles.size(); ++i)
        for (const ConvexPiece& piece : scene.environment.obstacles[i].shape.pieces) add(items, piece, bodies + i);
    const auto earlier = [](const Item& a, const Item& b) { return a.begin < b.begin; };
    std::stable_sort(items.begin(), items.end(), earlier);
    return items;
}

}  // namespace

std::optional<StartOverlap> findStartOverlap(const Scene& scene, double tolerance) {
    const std::vector<Item> items = itemsOf(scene);
    const std::size_t bodies = scene.bodyCount();
    std::vector<const Item*> open;  // items whose extent along x holds the current one's beginning
    for (const Item& item : items) {
        std::erase_if(open, [&](const Item* other) { return other->end < item.begin; });
        for (const Item* other : open) {
            const auto [first, second] = std::minmax(item.owner, other->owner);
            if (first == second || first >= bodies || !nearer(item.piece, other->piece, -tolerance)) continue;
            const double depth = -distance(item.piece, other->piece);
            if (depth <= tolerance) continue;
            if (second < bodies) return StartOverlap{second, first, 0, depth};
            return StartOverlap{first, std::nullopt, second - bodies, depth};
        }
        open.push_back(&item);
    }
    return std::nullopt;
}

std::optional<SceneSpan> spanOf(const Scene& scene) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Point low{far, far}, high{-far, -far};
    const auto include = [&](const Point& p, double reach) {
        low = {std::min(low.x, p.x - reach), std::min(low.y, p.y - reach)};
        high = {std::max(high.x, p.x + reach), std::max(high.y, p.y + reach)};
    };
    for (const Obstacle& obstacle : scene.environment.obstacles)
        for (const ConvexPiece& piece : obstacle.shape.pieces)
            for (std::size_t i = 0; obstacle.wall && i < piece.count; ++i) include(piece.corners[i], piece.radius);
    if (low.x > high.x) return {};
    for (const Point& corner : scene.environment.floor.area) include(corner, 0);
    return SceneSpan{low, high};
}

std::vector<std::size_t> startsOutside(const Scene& scene) {
    std::vector<std::size_t> outside;
    const auto span = spanOf(scene);
    for (std::size_t body = 0; span && body < scene.bodyCount(); ++body)
        if (!span->contains(position(startPoseOf(scene, body)))) outside.push_back(body);
    return outside;
}

}  // namespace mrose
