// The bound on an island's energy.
#include "physics/energy.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace mrose {
namespace {

double energyOf(const std::vector<RigidBody>& bodies) {
    double sum = 0;
    for (const RigidBody& b : bodies)
        if (b.inverseMass > 0)
            sum += 0.5 * (dot(b.velocity, b.velocity) / b.inverseMass + b.rotation * b.rotation / b.inverseInertia);
    return sum;
}

Point momentumOf(const std::vector<RigidBody>& bodies) {
    Point sum;
    for (const RigidBody& b : bodies)
        if (b.inverseMass > 0) sum = sum + (1 / b.inverseMass) * b.velocity;
    return sum;
}

struct Change {
    std::vector<RigidBody> before, after;
};

/// Bodies and the ground; all but the last body were pushed by one another.
Change randomChange(std::mt19937& random, double strength) {
    std::uniform_real_distribution<double> any(-1, 1);
    Change change;
    for (int i = 0; i < 6; ++i)
        change.before.push_back({1 / (1 + 9 * std::abs(any(random))),
                                 1 / (0.1 + std::abs(any(random))),
                                 {any(random), any(random)},
                                 3 * any(random)});
    change.before.emplace_back();
    change.after = change.before;
    for (int i = 0; i + 1 < 5; ++i) {
        const Point impulse{strength * any(random), strength * any(random)};
        change.after[i].push(-1 * impulse, 0.1 * strength * any(random));
        change.after[i + 1].push(impulse, 0.1 * strength * any(random));
    }
    return change;
}

TEST(TakeBackEnergy, LeavesAsMuchAsThereWasAndTheMomentum) {
    std::mt19937 random(1);
    int grew = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const auto [before, after] = randomChange(random, 5);
        std::vector<RigidBody> bodies = after;
        takeBackEnergy(before, bodies, false);
        EXPECT_LE(energyOf(bodies), std::max(energyOf(before), energyOf(after)) * (1 + 1e-12));
        if (energyOf(after) <= energyOf(before)) continue;
        ++grew;
        EXPECT_NEAR(energyOf(bodies), energyOf(before), 1e-11 * energyOf(before));
        EXPECT_NEAR(length(momentumOf(bodies) - momentumOf(after)), 0, 1e-12);
    }
    EXPECT_GT(grew, 1000);
}

TEST(TakeBackEnergy, OnTheGroundAllIsMadeSlowerAlike) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 500; ++trial) {
        const auto [before, after] = randomChange(random, 8);
        if (energyOf(after) <= energyOf(before)) continue;
        std::vector<RigidBody> bodies = after;
        takeBackEnergy(before, bodies, true);
        EXPECT_NEAR(energyOf(bodies), energyOf(before), 1e-11 * energyOf(before));
        const double share = bodies[0].rotation / after[0].rotation;
        for (std::size_t i = 0; i < 5; ++i)
            EXPECT_NEAR(length(bodies[i].velocity - share * after[i].velocity), 0, 1e-12);
    }
}

TEST(TakeBackEnergy, TouchesNothingThatDidNotGainAndNobodyWhoWasNotPushed) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 500; ++trial) {
        const auto [before, after] = randomChange(random, trial % 2 == 0 ? 0.05 : 5);
        std::vector<RigidBody> bodies = after;
        takeBackEnergy(before, bodies, trial % 4 < 2);
        const bool grew = energyOf(after) > energyOf(before);
        for (std::size_t i = grew ? 5 : 0; i < bodies.size(); ++i) {
            EXPECT_EQ(bodies[i].velocity, after[i].velocity);
            EXPECT_EQ(bodies[i].rotation, after[i].rotation);
        }
    }
}

}  // namespace
}  // namespace mrose
