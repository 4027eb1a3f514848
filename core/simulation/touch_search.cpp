#include "simulation/touch_search.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

// Up to here all pairs are tried, which is quicker than a grid.
constexpr std::size_t fewBodies = 24;

/// How far a turning body's points get off their chords.
double sagOf(const SweptBody& body) {
    const double turn = body.planned.heading - body.pose.heading;
    return body.shape->reach * turn * turn / 8;
}

constexpr std::uint32_t notPlaced = 0xffffffff;

}  // namespace

SweptBody SweptBody::of(const Shape& shape, const Pose& pose, const Pose& planned) {
    return {&shape, pose, planned,
            distance(position(pose), position(planned)) + shape.reach * std::abs(planned.heading - pose.heading)};
}

void TouchSearch::PlacedPieces::forget(std::size_t bodies) {
    pieces.clear();
    from.assign(bodies, notPlaced);
}

std::span<const ConvexPiece> TouchSearch::PlacedPieces::of(const SweptBody& body, std::uint32_t index) {
    const std::vector<ConvexPiece>& own = body.shape->pieces;
    if (from[index] == notPlaced) {
        from[index] = static_cast<std::uint32_t>(pieces.size());
        const Placement frame(body.*end);
        for (const ConvexPiece& piece : own) pieces.push_back(placed(piece, frame));
    }
    return {pieces.data() + from[index], own.size()};
}

std::pair<std::span<const ConvexPiece>, std::span<const ConvexPiece>> TouchSearch::both(
    PlacedPieces& placed, const SweptBody& first, std::uint32_t a, const SweptBody& second, std::uint32_t b) {
    placed.of(first, a);  // placing the second may move the first's
    const std::span<const ConvexPiece> theirs = placed.of(second, b);
    return {placed.of(first, a), theirs};
}

void TouchSearch::consider(std::span<const SweptBody> bodies, std::uint32_t a, std::uint32_t b) {
    const double reach = radii_[a] + radii_[b];
    const Point between = centres_[b] - centres_[a];
    if (dot(between, between) <= reach * reach) considerNear(bodies[a], a, bodies[b], b);
}

void TouchSearch::considerNear(const SweptBody& first, std::uint32_t a, const SweptBody& second, std::uint32_t b) {
    const double limit = first.travel + second.travel + margin;
    const auto [own, theirs] = both(before_, first, a, second, b);
    bool near = false, meet = false;
    for (std::size_t x = 0; x < own.size() && !meet; ++x)
        for (std::size_t y = 0; y < theirs.size() && !meet; ++y) {
            if (!mayBeNearer(own[x], theirs[y], limit)) continue;
            near = true;
            const double sag = sagOf(first) + sagOf(second);
            const auto [ownAfter, theirsAfter] = both(after_, first, a, second, b);
            meet = !stayApart(own[x], theirs[y], ownAfter[x], theirsAfter[y], margin + sag, pressed + sag);
        }
    if (near) bodyPairs_.push_back({a, b, meet});
}

void TouchSearch::considerObstacle(const SweptBody& body, std::uint32_t index, std::uint32_t piece,
                                   const ConvexPiece& obstacle) {
    const double limit = body.travel + margin;
    const Point centre = position(body.pose);
    // How far the middle is outside the obstacle's edges separates most bodies from it.
    double outside = length(obstacle.centre - centre) - obstacle.reach;
    for (std::size_t i = 0; i < obstacle.count && !obstacle.isCircle(); ++i)
        outside = std::max(outside, dot(obstacle.normals[i], centre - obstacle.corners[i]));
    if (outside > body.shape->reach + limit) return;
    const std::span<const ConvexPiece> own = before_.of(body, index);
    bool near = false, meet = false;
    for (std::size_t x = 0; x < own.size() && !meet; ++x) {
        if (!mayBeNearer(own[x], obstacle, limit)) continue;
        near = true;
        const double sag = sagOf(body);
        meet = !stayApart(own[x], obstacle, after_.of(body, index)[x], obstacle, margin + sag, pressed + sag);
    }
    if (near) obstaclePairs_.push_back({index, piece, meet});
}

void TouchSearch::findNear(std::span<const SweptBody> bodies) {
    const auto count = static_cast<std::uint32_t>(bodies.size());
    for (std::uint32_t a = 0; a < count; ++a)
        for (std::uint32_t b = a + 1; b < count; ++b) consider(bodies, a, b);
}

void TouchSearch::findNearInGrid(std::span<const SweptBody> bodies) {
    const double widest = *std::max_element(radii_.begin(), radii_.end());
    grid_.fill(centres_, 2 * widest, 4);
    grid_.visitNeighbours([&](std::uint32_t a, std::uint32_t b) { consider(bodies, a, b); });
    std::sort(bodyPairs_.begin(), bodyPairs_.end(),
              [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

void TouchSearch::find(std::span<const SweptBody> bodies, const ObstacleIndex& obstacles) {
    bodyPairs_.clear();
    obstaclePairs_.clear();
    before_.forget(bodies.size());
    after_.forget(bodies.size());
    centres_.clear();
    radii_.clear();
    for (const SweptBody& body : bodies) {
        centres_.push_back(position(body.pose));
        radii_.push_back(body.shape->reach + body.travel + margin / 2);
    }
    if (bodies.size() <= fewBodies)
        findNear(bodies);
    else
        findNearInGrid(bodies);
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
        const SweptBody& body = bodies[i];
        const auto tryPiece = [&](std::uint32_t piece) { considerObstacle(body, i, piece, obstacles.pieces()[piece]); };
        if (body.shape->reach + body.travel + margin <= obstacles.margin()) {
            for (const std::uint32_t piece : obstacles.near(position(body.pose))) tryPiece(piece);
        } else {
            for (std::uint32_t piece = 0; piece < obstacles.pieces().size(); ++piece) tryPiece(piece);
        }
    }
}

}  // namespace mrose
