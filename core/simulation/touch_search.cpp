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

std::span<const ConvexPiece> TouchSearch::placedPieces(const SweptBody& body, std::uint32_t index) {
    if (placedFrom_[index] == notPlaced) {
        placedFrom_[index] = static_cast<std::uint32_t>(placed_.size());
        const Placement frame(body.pose);
        for (const ConvexPiece& piece : body.shape->pieces) placed_.push_back(placed(piece, frame));
        const Placement after(body.planned);
        for (const ConvexPiece& piece : body.shape->pieces) placed_.push_back(placed(piece, after));
    }
    return {placed_.data() + placedFrom_[index], 2 * body.shape->pieces.size()};
}

void TouchSearch::consider(std::span<const SweptBody> bodies, std::uint32_t a, std::uint32_t b) {
    const double reach = radii_[a] + radii_[b];
    const Point between = centres_[b] - centres_[a];
    if (dot(between, between) <= reach * reach) considerNear(bodies[a], a, bodies[b], b);
}

void TouchSearch::considerNear(const SweptBody& first, std::uint32_t a, const SweptBody& second, std::uint32_t b) {
    const double limit = first.travel + second.travel + margin;
    placedPieces(first, a);  // placing the second may move the first's pieces in memory
    const std::span<const ConvexPiece> theirs = placedPieces(second, b), own = placedPieces(first, a);
    const std::size_t x1 = own.size() / 2, y1 = theirs.size() / 2;
    bool near = false, meet = false;
    for (std::size_t x = 0; x < x1 && !meet; ++x)
        for (std::size_t y = 0; y < y1 && !meet; ++y) {
            if (!mayBeNearer(own[x], theirs[y], limit)) continue;
            near = true;
            const double sag = sagOf(first) + sagOf(second);
            meet = !stayApart(own[x], theirs[y], own[x1 + x], theirs[y1 + y], margin + sag, pressed + sag);
        }
    if (near) bodyPairs_.push_back({a, b, meet});
}

void TouchSearch::considerObstacle(const SweptBody& body, std::uint32_t index, std::uint32_t piece,
                                   const ConvexPiece& obstacle) {
    const double limit = body.travel + margin;
    const Point centre = position(body.pose);
    // How far the middle is outside the obstacle's edges tells most bodies apart from it.
    double outside = length(obstacle.centre - centre) - obstacle.reach;
    for (std::size_t i = 0; i < obstacle.count && !obstacle.isCircle(); ++i)
        outside = std::max(outside, dot(obstacle.normals[i], centre - obstacle.corners[i]));
    if (outside > body.shape->reach + limit) return;
    const std::span<const ConvexPiece> own = placedPieces(body, index);
    const std::size_t after = own.size() / 2;
    bool near = false, meet = false;
    for (std::size_t x = 0; x < after && !meet; ++x) {
        if (!mayBeNearer(own[x], obstacle, limit)) continue;
        near = true;
        const double sag = sagOf(body);
        meet = !stayApart(own[x], obstacle, own[after + x], obstacle, margin + sag, pressed + sag);
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
    placed_.clear();
    placedFrom_.assign(bodies.size(), notPlaced);
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
