#pragma once

#include <array>
#include <cstdint>

#include "geometry/point.h"

namespace mrose {

/// What impulses see of a body. The ground is one of no inverse mass.
struct RigidBody {
    double inverseMass = 0, inverseInertia = 0;
    Point velocity;  ///< of the centre of mass, m/s
    double rotation = 0;

    void push(const Point& impulse, double turn) {
        velocity = velocity + inverseMass * impulse;
        rotation += inverseInertia * turn;
    }
};

/// Two bodies that press on each other at one or two spots, and rub.
///
/// Wanted are the impulses by which no spot approaches faster than it may, which push and do not pull, and rub by
/// Coulomb's law. Two spots lie on one line across the normal, so that their friction is one impulse along it.
struct PressedPair {
    struct Spot {
        Point armOfA, armOfB;  ///< from the centres of mass
        double wanted = 0;     ///< m/s: at least so fast they part along the normal
    };
    std::uint32_t a = 0, b = 0;  ///< of the bodies
    Point normal;                ///< from a to b
    double friction = 0;
    std::array<Spot, 2> spots;
    int count = 0;
    int rubs = 0;  ///< the spot through which the line of friction goes

    // N s: where the search begins, and its result.
    std::array<double, 2> pressed{};
    double rubbed = 0;  ///< along the normal turned by 90 degrees
};

}  // namespace mrose
