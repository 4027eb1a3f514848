#pragma once

#include <cstdint>
#include <span>

#include "physics/contact_physics.h"

namespace mrose {

/// Bodies that may touch one another, and the obstacles near them, as ranges of a task.
struct ContactCluster {
    std::size_t firstBody = 0, lastBody = 0;
    std::size_t firstObstacle = 0, lastObstacle = 0;
    double lightest = 0, heaviest = 0;  ///< kg
    Point origin;                       ///< near the bodies, so that float coordinates are fine everywhere

    std::size_t members() const { return lastBody - firstBody + (lastObstacle > firstObstacle ? 1 : 0); }
};

/// Orders impulses by whom they are between.
bool keyLess(const ContactImpulse& a, const ContactImpulse& b);

/// How far a body's centre of mass is planned to go, and whether it might pass through others on its way.
struct PlannedMove {
    Point way;  ///< m
    bool fast = false;
};
PlannedMove plannedMove(const ContactBody& body);

/// How thoroughly the solver must work at a tick of some clusters.
struct SolverEffort {
    int steps = 1;
    float stepLength = 0;     ///< s
    int iterations = 0;       ///< on velocities
    bool continuous = false;  ///< with continuous collision
};

/// moves[i] is of the clusters' i-th body; `before` are all impulses of the tick before, in order.
SolverEffort effortFor(const ContactTask& task, std::span<const ContactCluster> clusters,
                       std::span<const PlannedMove> moves, std::span<const ContactImpulse> before);

/// A light body that was held between two others in the tick before, and now is beside much heavier ones: the factor by
/// which it must weigh more, or the solver lets them sink into it. Otherwise 1.
double heldMassFactor(const ContactBody& body, const ContactCluster& cluster, std::span<const ContactImpulse> before);

}  // namespace mrose
