// Where no motor works, kinetic energy never rises: not in any tick, beyond the rounding of double.
#include <cmath>

#include <gtest/gtest.h>

#include "learning/parallel_for.h"
#include "simulation/small_world.h"
#include "support/contact_measures.h"
#include "support/outlines.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

// In a tick: share of the energy, and what is next to none, J.
constexpr double energyRounding = 1e-9, noEnergy = 1e-12;

struct Arena {
    double side = 2.6;  ///< m
    int columns = 4;
    bool robots = false;  ///< every other body is a robot told to stand
};

/// Bodies of any outline, mass and surface, thrown at up to 10 m/s in a place hardly larger than they are.
Scenario crowdedArena(const Arena& arena, std::int64_t number) {
    const auto draw = [&](std::int64_t body, std::uint32_t c) {
        return uniformNoise({41, number, static_cast<std::uint32_t>(body), c});
    };
    SmallWorld world(onIce(walledField(arena.side, arena.side, {draw(-1, 0), draw(-1, 1)})));
    world.parts().scene.randomFactor = number % 2 == 0 ? 0 : 0.5;
    // A robot's wheels act on its velocity of the moment: they take from it and never restore one.
    KinematicParameters coasting;
    coasting.v.lag = coasting.w.lag = 0.5;
    const auto model = std::make_shared<const KinematicModel>(coasting, 20 * ms);
    const double pitch = arena.side / arena.columns;
    for (int i = 0; i < arena.columns * arena.columns; ++i) {
        const Pose start{pitch * (i % arena.columns + 0.5), pitch * (i / arena.columns + 0.5), 2 * pi * draw(i, 0)};
        const double mass = 0.1 * std::pow(500, draw(i, 1));
        const Surface surface{draw(i, 2), draw(i, 3)};
        const double speed = 10 * draw(i, 4), way = 2 * pi * draw(i, 5);
        const Twist velocity{speed * std::cos(way), speed * std::sin(way), 10 * draw(i, 6) - 5};
        const auto& outlines = trickyOutlines();
        const auto& shape = outlines[static_cast<std::size_t>(draw(i, 7) * static_cast<double>(outlines.size()))];
        if (arena.robots && i % 2 == 0)
            world.robot(robotOf(outlines[static_cast<std::size_t>(5 + i / 2 % 2)], mass, surface), start,
                        std::make_shared<const Told>(Command{}), model);
        else if (i % 3 == 1)
            world.object(rollingBody(0.11, mass, surface), start, velocity);
        else
            world.object(slidingBody(shape, mass, surface), start, velocity);
    }
    return world.scenario();
}

/// The first tick with more energy than the one before; "" where there is none.
std::string energyGain(const Scenario& scenario, std::int64_t seed, int ticks, int& touching) {
    WorldState state = scenario.initialState(static_cast<std::uint64_t>(seed));
    StepBuffers buffers;
    StepTrace trace;
    double before = movedBy(scenario, state).energy;
    for (int k = 0; k < ticks; ++k) {
        step(scenario, state, buffers, {}, &trace);
        const double now = movedBy(scenario, state).energy;
        touching += trace.contacts.empty() ? 0 : 1;
        if (!(now <= before * (1 + energyRounding) + noEnergy))
            return "seed " + std::to_string(seed) + ", tick " + std::to_string(k) + ": " +
                   std::to_string(1e6 * (now / before - 1)) + " millionths of " + std::to_string(before) + " J";
        before = now;
    }
    return "";
}

void expectNoGain(const Arena& arena, std::size_t seeds, int ticks, int leastTouching) {
    std::vector<std::string> wrong(seeds);
    std::vector<int> touching(seeds);
    parallelFor(seeds, [&](std::size_t i) {
        const auto number = static_cast<std::int64_t>(i);
        wrong[i] = energyGain(crowdedArena(arena, number), number, ticks, touching[i]);
    });
    for (std::size_t i = 0; i < seeds; ++i) {
        EXPECT_EQ(wrong[i], "");
        EXPECT_TRUE(!wrong[i].empty() || touching[i] > leastTouching) << i << ": " << touching[i];
    }
}

TEST(ContactEnergy, NeverRisesInACrowdedArena) { expectNoGain({2.6, 4, false}, 24, 2000, 100); }
TEST(ContactEnergy, NeverRisesAmongFew) { expectNoGain({1.6, 2, false}, 24, 2000, 10); }
TEST(ContactEnergy, NeverRisesWhereRobotsAreHitThatAreToldToStand) { expectNoGain({2.6, 4, true}, 24, 1000, 30); }

/// Without loss none is lost either: a ball between elastic walls, in its corners too.
TEST(ContactEnergy, OfAnElasticBallBetweenWallsStays) {
    SmallWorld world(onIce(walledField(1.3, 1, {0, 1})));
    world.object(rollingBody(0.11, 0.43, {0, 1}), {0.4, 0.4, 0}, {3.1, 2.3, 4});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    const double before = movedBy(scenario, state).energy;
    run(scenario, state, 20'000);
    EXPECT_NEAR(movedBy(scenario, state).energy / before, 1, 1e-9);
}

/// In the open: momentum, too, of whatever form they are.
TEST(ContactEnergy, MomentumStaysWithoutWalls) {
    for (std::int64_t number = 0; number < 60; ++number) {
        const auto draw = [&](std::uint32_t c) { return uniformNoise({42, number, 0, c}); };
        const auto& outlines = trickyOutlines();
        const auto any = [&](std::uint32_t c) {
            return outlines[static_cast<std::size_t>(draw(c) * static_cast<double>(outlines.size()))];
        };
        SmallWorld world(onIce());
        const Surface surface{draw(0), draw(1)};
        world.object(slidingBody(any(2), 0.1 * std::pow(500, draw(3)), surface), {-0.7, 0.2 * draw(4), 6 * draw(5)},
                     {1 + 8 * draw(6), draw(7), 3 * draw(8)});
        world.object(slidingBody(any(9), 0.1 * std::pow(500, draw(10)), surface), {0.2, 0, 6 * draw(11)},
                     {-draw(12), 0, 3 * draw(13)});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        const Moved before = movedBy(scenario, state);
        const double scale =
            length(movedBy(scenario, state, 0).momentum) + length(movedBy(scenario, state, 1).momentum);
        run(scenario, state, 60);
        const Moved after = movedBy(scenario, state);
        EXPECT_NEAR(after.momentum.x, before.momentum.x, 1e-9 * scale) << number;
        EXPECT_NEAR(after.momentum.y, before.momentum.y, 1e-9 * scale) << number;
        EXPECT_NEAR(after.angular, before.angular, 1e-3 * scale)
            << number << ": pressed apart, they may shift a little";
    }
}

}  // namespace
}  // namespace mrose
