// The solvers of impulses against the conditions that define what they look for: no spot approaches faster than it may,
// impulses push, what parts is not pushed, and friction is Coulomb's.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "physics/exact_impulses.h"
#include "physics/impulse_sweeps.h"

namespace mrose {
namespace {

struct Island {
    std::vector<RigidBody> bodies;  ///< the last is the ground
    std::vector<PressedPair> pairs;
};

double mixed(std::mt19937& random, double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
}

/// Of a disc of a mass drawn evenly in its logarithm.
RigidBody randomBody(std::mt19937& random, double heaviest) {
    const double mass = std::pow(heaviest, mixed(random, 0, 1)), radius = 0.25;
    return {1 / mass, 2 / (mass * radius * radius), {mixed(random, -1, 1), mixed(random, -1, 1)}, mixed(random, -3, 3)};
}

/// At one spot or two, `halfway` from a's centre to b's (or the ground's edge).
PressedPair randomPair(std::mt19937& random, std::uint32_t a, std::uint32_t b, const Point& halfway, bool grounded) {
    PressedPair pair;
    pair.a = a;
    pair.b = b;
    pair.normal = (1 / length(halfway)) * halfway;
    pair.friction = mixed(random, 0, 0.4);
    pair.count = random() % 2 == 0 ? 1 : 2;
    const Point along{-pair.normal.y, pair.normal.x};
    for (int i = 0; i < pair.count; ++i) {
        const Point aside = (i == 0 ? 1 : -1) * mixed(random, 0.02, 0.1) * along;
        pair.spots[i] = {halfway + aside, grounded ? Point{} : aside - halfway,
                         random() % 3 == 0 ? mixed(random, -0.5, 0.5) : 0.0};
    }
    return pair;
}

/// Discs on a grid, each pressing on its neighbours, the lowest row on the ground.
Island heap(std::mt19937& random, std::uint32_t wide, std::uint32_t high, double heaviest) {
    Island island;
    for (std::uint32_t i = 0; i < wide * high; ++i) island.bodies.push_back(randomBody(random, heaviest));
    const std::uint32_t ground = wide * high;
    island.bodies.emplace_back();
    const auto at = [&](std::uint32_t x, std::uint32_t y) { return y * wide + x; };
    const auto slightly = [&] { return mixed(random, -0.05, 0.05); };
    for (std::uint32_t y = 0; y < high; ++y)
        for (std::uint32_t x = 0; x < wide; ++x) {
            if (x + 1 < wide)
                island.pairs.push_back(randomPair(random, at(x, y), at(x + 1, y), {0.25, slightly()}, false));
            if (y > 0)
                island.pairs.push_back(randomPair(random, at(x, y), at(x, y - 1), {slightly(), -0.25}, false));
            else
                island.pairs.push_back(randomPair(random, at(x, y), ground, {slightly(), -0.25}, true));
        }
    return island;
}

Point velocityAt(const RigidBody& body, const Point& arm) {
    return body.velocity + body.rotation * Point{-arm.y, arm.x};
}

/// m/s for each N s along a direction.
double effectOn(const RigidBody& body, const Point& arm, const Point& direction) {
    const double lever = cross(arm, direction);
    return body.inverseMass + body.inverseInertia * lever * lever;
}

/// How far a pair is from its conditions, as the residual of a projection: m/s. 0 where all hold.
double violation(const PressedPair& pair, const std::vector<RigidBody>& bodies) {
    const RigidBody &a = bodies[pair.a], &b = bodies[pair.b];
    const auto partsAt = [&](const PressedPair::Spot& spot) {
        return velocityAt(b, spot.armOfB) - velocityAt(a, spot.armOfA);
    };
    const auto effect = [&](const PressedPair::Spot& spot, const Point& direction) {
        return effectOn(a, spot.armOfA, direction) + effectOn(b, spot.armOfB, direction);
    };
    double worst = 0, presses = 0;
    for (int i = 0; i < pair.count; ++i) {
        const PressedPair::Spot& spot = pair.spots[i];
        const double excess = dot(partsAt(spot), pair.normal) - spot.wanted;
        worst = std::max(worst, std::abs(std::min(pair.pressed[i] * effect(spot, pair.normal), excess)));
        presses += pair.pressed[i];
    }
    const Point along{-pair.normal.y, pair.normal.x};
    const PressedPair::Spot& spot = pair.spots[pair.rubs];
    const double ofRubbing = effect(spot, along), slip = dot(partsAt(spot), along);
    const double most = pair.friction * std::max(0.0, presses) * ofRubbing, rubs = pair.rubbed * ofRubbing;
    return std::max(worst, std::abs(rubs - std::clamp(rubs - slip, -most, most)));
}

double violation(const Island& island) {
    double worst = 0;
    for (const PressedPair& pair : island.pairs) worst = std::max(worst, violation(pair, island.bodies));
    return worst;
}

/// That the bodies move as the impulses push them.
void expectPushed(const Island& before, const Island& after) {
    std::vector<RigidBody> bodies = before.bodies;
    for (const PressedPair& pair : after.pairs) {
        const Point along{-pair.normal.y, pair.normal.x};
        const auto push = [&](const PressedPair::Spot& spot, const Point& impulse) {
            bodies[pair.a].push(-1 * impulse, -cross(spot.armOfA, impulse));
            bodies[pair.b].push(impulse, cross(spot.armOfB, impulse));
        };
        for (int i = 0; i < pair.count; ++i) push(pair.spots[i], pair.pressed[i] * pair.normal);
        push(pair.spots[pair.rubs], pair.rubbed * along);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        EXPECT_NEAR(length(bodies[i].velocity - after.bodies[i].velocity), 0, 1e-7);
        EXPECT_NEAR(bodies[i].rotation, after.bodies[i].rotation, 1e-6);
    }
}

TEST(Impulses, OfOnePairMeetTheirConditionsExactly) {
    std::mt19937 random(1);
    ExactImpulses exact;
    int pressing = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
        const bool grounded = trial % 3 == 0;
        Island island;
        island.bodies = {randomBody(random, 1e3), randomBody(random, 1e3), {}};
        const double way = mixed(random, -3, 3);
        island.pairs = {
            randomPair(random, 0, grounded ? 2 : 1, {0.25 * std::cos(way), 0.25 * std::sin(way)}, grounded)};
        const Island before = island;
        ASSERT_TRUE(exact.find(island.bodies, island.pairs));
        ASSERT_LT(violation(island), 1e-9) << trial;
        expectPushed(before, island);
        pressing += island.pairs[0].pressed[0] > 0 ? 1 : 0;
    }
    EXPECT_GT(pressing, 5000);
}

TEST(Impulses, OfFewPairsMeetTheirConditionsWhateverTheMasses) {
    std::mt19937 random(2);
    ExactImpulses exact;
    int found = 0;
    constexpr int trials = 500;
    for (int trial = 0; trial < trials; ++trial) {
        Island island = heap(random, 2 + trial % 2, 2, 1e3);
        const Island before = island;
        if (!exact.find(island.bodies, island.pairs)) continue;
        ++found;
        ASSERT_LT(violation(island), 2 * PairBlock::settled) << trial;
        expectPushed(before, island);
    }
    EXPECT_GT(found, trials * 9 / 10);
}

TEST(Impulses, OfManyPairsSettleBySweeps) {
    std::mt19937 random(3);
    ImpulseSweeps sweeps;
    int settled = 0;
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
        Island island = heap(random, 6, 1 + trial % 5, 30);
        const Island before = island;
        if (!sweeps.find(island.bodies, island.pairs, 400)) continue;
        ++settled;
        ASSERT_LT(violation(island), 5 * PairBlock::settled) << trial;
        expectPushed(before, island);
    }
    EXPECT_GT(settled, trials * 95 / 100);
}

/// Without friction the velocities are unique: the projection of the free ones (Moreau).
TEST(Impulses, WithoutFrictionBothSolversAgreeHoweverTheyBegin) {
    std::mt19937 random(4);
    ExactImpulses exact;
    ImpulseSweeps sweeps;
    for (int trial = 0; trial < 200; ++trial) {
        Island one = heap(random, 2 + trial % 2, 2, 10);
        for (PressedPair& pair : one.pairs) pair.friction = 0;
        Island other = one;
        for (PressedPair& pair : other.pairs) pair.pressed[0] = mixed(random, 0, 2);
        if (!exact.find(one.bodies, one.pairs)) continue;
        ASSERT_TRUE(sweeps.find(other.bodies, other.pairs, 2000)) << trial;
        for (std::size_t i = 0; i < one.bodies.size(); ++i)
            EXPECT_NEAR(length(one.bodies[i].velocity - other.bodies[i].velocity), 0, 0.02) << trial;
    }
}

}  // namespace
}  // namespace mrose
