#pragma once

#include <cstddef>

#include "scenario/scenario.h"

namespace mrose {

/// m, between the true shapes of two bodies; where they overlap minus the depth. By the pair of pieces that is nearest.
double gapBetween(const Scenario& scenario, const WorldState& state, std::size_t a, std::size_t b);

/// The same to all that stands still; infinite without obstacles.
double gapToObstacles(const Scenario& scenario, const WorldState& state, std::size_t body);

/// The least of the gaps of a body to others and to obstacles, and that of all bodies.
double leastGap(const Scenario& scenario, const WorldState& state, std::size_t body);
double leastGap(const Scenario& scenario, const WorldState& state);

/// How deep a point is in a shape, in its frame, m: the distance to it, negative, where it is outside.
double depthOfPoint(const Shape& shape, const Point& point_B);

/// What bodies have together, or one of them, about their centres of mass; without what rolling adds, which contact
/// leaves alone.
struct Moved {
    Point momentum;      ///< N s
    double angular = 0;  ///< N m s, about the world's origin
    double energy = 0;   ///< J
};
Moved movedBy(const Scenario& scenario, const WorldState& state, std::size_t body);
Moved movedBy(const Scenario& scenario, const WorldState& state);

}  // namespace mrose
