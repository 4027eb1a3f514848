#include "simulation/touch_search.h"

#include <algorithm>
#include <array>
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

using Pair = TouchSearch::Pair;

bool before(const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; }

/// Of the pairs behind the first `known`, which are in order, keeps those that are not among them, and puts all in
/// order. The first bodies of the new ones.
std::vector<std::uint32_t> addNew(std::vector<Pair>& pairs, std::size_t known) {
    const auto behind = pairs.begin() + static_cast<std::ptrdiff_t>(known);
    std::sort(behind, pairs.end(), before);
    pairs.erase(std::unique(behind, pairs.end(), [](const Pair& p, const Pair& q) { return p.a == q.a && p.b == q.b; }),
                pairs.end());
    pairs.erase(
        std::remove_if(behind, pairs.end(),
                       [&](const Pair& pair) { return std::binary_search(pairs.begin(), behind, pair, before); }),
        pairs.end());
    std::vector<std::uint32_t> bodies;
    for (auto pair = behind; pair != pairs.end(); ++pair) bodies.push_back(pair->a);
    std::inplace_merge(pairs.begin(), behind, pairs.end(), before);
    return bodies;
}

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
    if (circles_[a].meets(circles_[b])) considerNear(bodies[a], a, bodies[b], b);
}

void TouchSearch::remember(std::span<const ContactImpulse> pressed, std::size_t bodies) {
    pressedBodies_.clear();
    pressedObstacles_.clear();
    leans_.assign(bodies, false);
    for (const ContactImpulse& impulse : pressed) {
        if (impulse.bodyA >= bodies) continue;
        leans_[impulse.bodyA] = true;
        if (impulse.bodyB == noBody)
            pressedObstacles_.emplace_back(impulse.bodyA, impulse.pieceB);
        else
            pressedBodies_.push_back(std::minmax(impulse.bodyA, impulse.bodyB));
    }
    std::sort(pressedBodies_.begin(), pressedBodies_.end());
    std::sort(pressedObstacles_.begin(), pressedObstacles_.end());
}

bool TouchSearch::pressedBodies(std::uint32_t a, std::uint32_t b) const {
    return (leans_[a] || leans_[b]) && std::binary_search(pressedBodies_.begin(), pressedBodies_.end(), Key(a, b));
}

bool TouchSearch::pressedObstacle(std::uint32_t body, std::uint32_t piece) const {
    return leans_[body] && std::binary_search(pressedObstacles_.begin(), pressedObstacles_.end(), Key(body, piece));
}

void TouchSearch::considerNear(const SweptBody& first, std::uint32_t a, const SweptBody& second, std::uint32_t b) {
    if (pressedBodies(a, b)) {
        bodyPairs_.push_back({a, b, true});
        return;
    }
    const double limit = first.travel + second.travel + margin;
    const auto [own, theirs] = both(before_, first, a, second, b);
    bool near = false, meet = false;
    for (std::size_t x = 0; x < own.size() && !meet; ++x)
        for (std::size_t y = 0; y < theirs.size() && !meet; ++y) {
            if (!nearer(own[x], theirs[y], limit)) continue;
            near = true;
            const double sag = sagOf(first) + sagOf(second);
            const auto [ownAfter, theirsAfter] = both(after_, first, a, second, b);
            meet = !stayApart(own[x], theirs[y], ownAfter[x], theirsAfter[y], margin + sag, touching + sag);
        }
    if (near) bodyPairs_.push_back({a, b, meet});
}

void TouchSearch::considerObstacle(const SweptBody& body, std::uint32_t index, std::uint32_t piece,
                                   const ObstacleIndex& obstacles) {
    if (pressedObstacle(index, piece)) {
        obstaclePairs_.push_back({index, piece, true});
        return;
    }
    const ConvexPiece& obstacle = obstacles.pieces()[piece];
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
        if (!nearer(own[x], obstacle, limit)) continue;
        near = true;
        const double sag = sagOf(body);
        meet = !stayApart(own[x], obstacle, after_.of(body, index)[x], obstacle, margin + sag, touching + sag);
    }
    if (near) obstaclePairs_.push_back({index, piece, meet});
}

void TouchSearch::findNear(std::span<const SweptBody> bodies) {
    const auto count = static_cast<std::uint32_t>(bodies.size());
    std::array<std::uint32_t, fewBodies> near;
    for (std::uint32_t a = 0; a < count; ++a) {
        const Circle circle = circles_[a];
        auto end = near.begin();
        for (std::uint32_t b = a + 1; b < count; ++b)
            if (circle.meets(circles_[b])) *end++ = b;
        for (auto b = near.begin(); b != end; ++b) considerNear(bodies[a], a, bodies[*b], *b);
    }
}

double TouchSearch::widest() const {
    double widest = 0;
    for (const Circle& circle : circles_) widest = std::max(widest, circle.radius);
    return widest;
}

void TouchSearch::findNearInGrid(std::span<const SweptBody> bodies) {
    centres_.resize(circles_.size());
    std::transform(circles_.begin(), circles_.end(), centres_.begin(), [](const Circle& c) { return c.centre; });
    grid_.fill(centres_, 2 * widest(), 4);
    grid_.visitNeighbours([&](std::uint32_t a, std::uint32_t b) { consider(bodies, a, b); });
    std::sort(bodyPairs_.begin(), bodyPairs_.end(), before);
}

void TouchSearch::find(std::span<const SweptBody> bodies, const ObstacleIndex& obstacles,
                       std::span<const ContactImpulse> pressed) {
    remember(pressed, bodies.size());
    bodyPairs_.clear();
    obstaclePairs_.clear();
    before_.forget(bodies.size());
    after_.forget(bodies.size());
    circles_.resize(bodies.size());
    std::transform(bodies.begin(), bodies.end(), circles_.begin(), Circle::of);
    if (bodies.size() <= fewBodies)
        findNear(bodies);
    else
        findNearInGrid(bodies);
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
        for (const std::uint32_t piece : obstaclesNear(i, obstacles)) considerObstacle(bodies[i], i, piece, obstacles);
}

std::vector<std::uint32_t> TouchSearch::widen(std::span<const SweptBody> bodies, std::span<const std::uint32_t> grown,
                                              const ObstacleIndex& obstacles) {
    const std::size_t known = bodyPairs_.size(), knownObstacles = obstaclePairs_.size();
    for (const std::uint32_t a : grown) circles_[a] = Circle::of(bodies[a]);
    for (const std::uint32_t a : grown) {
        const auto with = [&](std::uint32_t b) {
            if (b != a) consider(bodies, std::min(a, b), std::max(a, b));
        };
        if (bodies.size() <= fewBodies) {
            for (std::uint32_t b = 0; b < bodies.size(); ++b) with(b);
        } else {
            const auto& [centre, radius] = circles_[a];
            const Point reach{radius + widest(), radius + widest()};
            grid_.visitBox(centre - reach, centre + reach, [&](std::span<const PointGrid::Entry> entries) {
                for (const PointGrid::Entry& entry : entries) with(entry.number);
            });
        }
        for (const std::uint32_t piece : obstaclesNear(a, obstacles)) considerObstacle(bodies[a], a, piece, obstacles);
    }
    std::vector<std::uint32_t> met;
    for (const std::uint32_t body : addNew(bodyPairs_, known)) met.push_back(body);
    for (const std::uint32_t body : addNew(obstaclePairs_, knownObstacles)) met.push_back(body);
    return met;
}

}  // namespace mrose
