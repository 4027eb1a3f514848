#include "behaviour/wander.h"

#include <set>

#include <gtest/gtest.h>

#include "behaviour/headway.h"
#include "behaviour/small_field.h"

namespace mrose {
namespace {

TEST(Wander, NeverStandsStillForLong) {
    for (const int robots : {1, 5})
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            SmallWorld world(walledField(4, 4));
            for (int i = 0; i < robots; ++i)
                world.robot(guideRobot(cameras()), {0.8 + 1.1 * (i % 3), 0.8 + 1.2 * (i / 3), 1.3 * i},
                            std::make_shared<const Wander>(Wander::Options{}), noisyDrive(), i % 5);
            const Scenario scenario = world.scenario();
            WorldState state = scenario.initialState(seed);
            StepBuffers buffers;
            std::vector<Headway> shortly(static_cast<std::size_t>(robots), Headway(4 * ticksPerSecond)),
                lately(static_cast<std::size_t>(robots), Headway(40 * ticksPerSecond / 5));
            for (int tick = 0; tick < 90 * ticksPerSecond; ++tick) {
                step(scenario, state, buffers);
                for (std::size_t i = 0; i < state.robots.size(); ++i) {
                    shortly[i].watch(state.robots[i].pose);
                    if (tick % 5 == 0) lately[i].watch(state.robots[i].pose);
                }
            }
            for (std::size_t i = 0; i < state.robots.size(); ++i) {
                EXPECT_GT(shortly[i].leastMotion(), 0.02) << robots << " robots, seed " << seed;
                EXPECT_GT(lately[i].leastWay(), 0.15) << robots << " robots, seed " << seed;
            }
        }
}

TEST(Wander, GoesDifferentWaysBySeedAndSeesTheWholePlace) {
    std::set<std::pair<int, int>> cells;
    std::set<double> ends;
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Scenario scenario =
            SmallWorld(walledField(4, 4))
                .robot(guideRobot({}), {2, 2, 0}, std::make_shared<const Wander>(Wander::Options{}), noisyDrive())
                .scenario();
        WorldState state = scenario.initialState(seed);
        StepBuffers buffers;
        for (int tick = 0; tick < 120 * ticksPerSecond; ++tick) {
            step(scenario, state, buffers);
            cells.insert({static_cast<int>(state.robots[0].pose.x), static_cast<int>(state.robots[0].pose.y)});
        }
        ends.insert(state.robots[0].pose.x);
    }
    EXPECT_EQ(ends.size(), 5u);
    EXPECT_GE(cells.size(), 14u);
}

/// Of its own accord it touches no wall; without knowing them it does.
TEST(Wander, TurnsAwayFromWallsThatItKnows) {
    for (const bool knows : {true, false}) {
        int touching = 0;
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            const Environment field = walledField(5, 3);
            Wander::Options options;
            options.radius = 0.31;
            if (knows) options.walls = floorPlanOf(field);
            const Scenario scenario = SmallWorld(field)
                                          .robot(guideRobot(cameras()), {2.5, 1.5, 0.7 * static_cast<double>(seed)},
                                                 std::make_shared<const Wander>(options), noisyDrive())
                                          .scenario();
            WorldState state = scenario.initialState(seed);
            StepBuffers buffers;
            StepTrace trace;
            Headway progress(40 * ticksPerSecond / 5);
            for (int tick = 0; tick < 120 * ticksPerSecond; ++tick) {
                step(scenario, state, buffers, {}, &trace);
                touching += trace.contacts.empty() ? 0 : 1;
                if (tick % 5 == 0) progress.watch(state.robots[0].pose);
            }
            EXPECT_GT(progress.leastWay(), 0.3) << seed;
        }
        if (knows)
            EXPECT_LT(touching, 10 * 120 * ticksPerSecond / 200);
        else
            EXPECT_GT(touching, 10 * 120 * ticksPerSecond / 50);
    }
}

TEST(Wander, TurnsSmoothly) {
    const Scenario scenario =
        SmallWorld()
            .robot(guideRobot({}), {}, std::make_shared<const Wander>(Wander::Options{}), noisyDrive())
            .scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    double last = 0, most = 0;
    for (int tick = 0; tick < 120 * ticksPerSecond; ++tick) {
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].decided) continue;
        const double w = trace.robots[0].decision.command->w;
        EXPECT_LT(std::abs(w - last), 0.25);
        most = std::max(most, std::abs(w));
        last = w;
    }
    EXPECT_GT(most, 0.2);
    EXPECT_LT(most, 0.55);
}

TEST(Wander, TurnsAwayFromABodyAhead) {
    const Scenario scenario =
        SmallWorld()
            .robot(guideRobot({}), {}, std::make_shared<const Wander>(Wander::Options{}), noisyDrive())
            .object(boxType(0.4, 500), {2, 0.1, 0})
            .scenario();
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        WorldState state = scenario.initialState(seed);
        StepBuffers buffers;
        StepTrace trace;
        for (int tick = 0; tick < 20 * ticksPerSecond; ++tick) {
            step(scenario, state, buffers, {}, &trace);
            EXPECT_TRUE(trace.contacts.empty()) << seed;
        }
    }
}

}  // namespace
}  // namespace mrose
