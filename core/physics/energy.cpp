#include "physics/energy.h"

#include <cmath>

namespace mrose {
namespace {

constexpr double rounding = 1e-14;  // share of an energy

double twiceTheEnergy(const RigidBody& body) {
    return dot(body.velocity, body.velocity) / body.inverseMass + body.rotation * body.rotation / body.inverseInertia;
}

}  // namespace

void takeBackEnergy(std::span<const RigidBody> before, std::span<RigidBody> bodies, bool grounded) {
    const auto touched = [&](std::size_t i) {
        return bodies[i].inverseMass > 0 &&
               (!(bodies[i].velocity == before[i].velocity) || bodies[i].rotation != before[i].rotation);
    };
    double had = 0, has = 0, mass = 0;
    Point momentum;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!touched(i)) continue;
        had += twiceTheEnergy(before[i]);
        has += twiceTheEnergy(bodies[i]);
        mass += 1 / bodies[i].inverseMass;
        momentum = momentum + (1 / bodies[i].inverseMass) * bodies[i].velocity;
    }
    if (has <= had * (1 + rounding)) return;
    Point common = (1 / mass) * momentum;
    double kept = mass * dot(common, common);
    if (grounded || kept >= had) {
        common = {};
        kept = 0;
    }
    const double share = std::sqrt((had - kept) / (has - kept));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        if (!touched(i)) continue;
        bodies[i].velocity = common + share * (bodies[i].velocity - common);
        bodies[i].rotation *= share;
    }
}

}  // namespace mrose
