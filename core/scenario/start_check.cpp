#include "scenario/start_check.h"

#include <algorithm>
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

std::vector<Item> itemsOf(const Scene& scene) {
    std::vector<Item> items;
    const std::size_t bodies = scene.bodyCount();
    for (std::size_t body = 0; body < bodies; ++body) {
        const bool robot = body < scene.robots.size();
        const Placement placement(robot ? scene.robots[body].start : scene.objects[body - scene.robots.size()].start);
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
            if (first == second || first >= bodies || !mayBeNearer(item.piece, other->piece, -tolerance)) continue;
            const double depth = -distance(item.piece, other->piece);
            if (depth <= tolerance) continue;
            if (second < bodies) return StartOverlap{second, first, 0, depth};
            return StartOverlap{first, std::nullopt, second - bodies, depth};
        }
        open.push_back(&item);
    }
    return std::nullopt;
}

}  // namespace mrose
