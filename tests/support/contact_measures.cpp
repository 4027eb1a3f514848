#include "support/contact_measures.h"

#include <algorithm>
#include <limits>

namespace mrose {
namespace {

/// Depths of a millimetre matter, not distances: beyond this far only a lower bound is found.
constexpr double farApart = 0.05;

double boundOfGap(const ConvexPiece& a, const ConvexPiece& b) {
    return distance(a.centre, b.centre) - a.reach - b.reach;
}

double gapOf(const ConvexPiece& a, const ConvexPiece& b) {
    const double bound = boundOfGap(a, b);
    return bound > farApart ? bound : distance(a, b);
}

}  // namespace

double gapBetween(const Scenario& scenario, const WorldState& state, std::size_t a, std::size_t b) {
    const Shape &one = scenario.scene().shapeOf(a), &other = scenario.scene().shapeOf(b);
    const Pose &there = Scenario::poseOf(state, a), &here = Scenario::poseOf(state, b);
    const double bound = distance(position(there), position(here)) - one.reach - other.reach;
    if (bound > farApart) return bound;
    const Placement first(there), second(here);
    double least = std::numeric_limits<double>::infinity();
    for (const ConvexPiece& x : one.pieces) {
        const ConvexPiece own = placed(x, first);
        for (const ConvexPiece& y : other.pieces) least = std::min(least, gapOf(own, placed(y, second)));
    }
    return least;
}

double gapToObstacles(const Scenario& scenario, const WorldState& state, std::size_t body) {
    double least = std::numeric_limits<double>::infinity();
    const Placement placement(Scenario::poseOf(state, body));
    for (const ConvexPiece& x : scenario.scene().shapeOf(body).pieces) {
        const ConvexPiece own = placed(x, placement);
        for (const ConvexPiece& obstacle : scenario.obstacles().pieces()) least = std::min(least, gapOf(own, obstacle));
    }
    return least;
}

double leastGap(const Scenario& scenario, const WorldState& state, std::size_t body) {
    double least = gapToObstacles(scenario, state, body);
    for (std::size_t other = 0; other < scenario.scene().bodyCount(); ++other)
        if (other != body) least = std::min(least, gapBetween(scenario, state, body, other));
    return least;
}

double leastGap(const Scenario& scenario, const WorldState& state) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < scenario.scene().bodyCount(); ++a) {
        least = std::min(least, gapToObstacles(scenario, state, a));
        for (std::size_t b = 0; b < a; ++b) least = std::min(least, gapBetween(scenario, state, a, b));
    }
    return least;
}

double depthOfPoint(const Shape& shape, const Point& point_B) {
    double deepest = -std::numeric_limits<double>::infinity();
    for (const ConvexPiece& piece : shape.pieces)
        deepest = std::max(deepest, -distance(ConvexPiece::circle(point_B, 0), piece));
    return deepest;
}

Moved movedBy(const Scenario& scenario, const WorldState& state, std::size_t body) {
    const auto& type = scenario.contactType(body);
    const Placement placement(Scenario::poseOf(state, body));
    Twist velocity;  // of the reference point, in the world
    if (body < state.robots.size()) {
        const Twist& own = state.robots[body].velocity_B;
        const Point turned = placement.rotate({own.x, own.y});
        velocity = {turned.x, turned.y, own.rotation};
    } else {
        velocity = state.objects[body - state.robots.size()].velocity_W;
    }
    const Point arm = placement.rotate(type.centre);
    const Point v{velocity.x - velocity.rotation * arm.y, velocity.y + velocity.rotation * arm.x};
    Moved moved;
    moved.momentum = type.mass * v;
    moved.angular = cross(placement.place(type.centre), moved.momentum) + type.inertia * velocity.rotation;
    moved.energy = (type.mass * dot(v, v) + type.inertia * velocity.rotation * velocity.rotation) / 2;
    return moved;
}

Moved movedBy(const Scenario& scenario, const WorldState& state) {
    Moved sum;
    for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) {
        const Moved one = movedBy(scenario, state, body);
        sum.momentum = sum.momentum + one.momentum;
        sum.angular += one.angular;
        sum.energy += one.energy;
    }
    return sum;
}

}  // namespace mrose
