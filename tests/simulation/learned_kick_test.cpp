// A learned kicker in the world: what it does is of the distributions that its network says, and drawn by counters.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "manipulation/learned_kicker.h"
#include "simulation/kicking_world.h"
#include "support/kolmogorov.h"
#include "support/planted_kicker.h"
#include "support/units.h"
#include "world/state_bytes.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

/// What one run's first kick did, and what it depended on.
struct FirstKick {
    Nanoseconds delay = 0;
    KickState commanded, acted;
    StepTrace::Kicked kicked;
    double heading = 0;
};

std::optional<FirstKick> firstKick(std::uint64_t seed) {
    const Scenario scenario = kickingScenario(seed);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    FirstKick first;
    for (int k = 0; k < 40; ++k) {
        const RobotState robot = state.robots[0];
        const Velocity velocity{robot.velocity_B.x, robot.velocity_B.rotation};
        StepTrace trace;
        const Point ball_B = Placement(robot.pose).placeBack(position(state.objects[0].pose));
        step(scenario, state, buffers, {}, &trace);
        if (k == 0) first.commanded = {0.8, velocity, {}};
        if (k == 0 && !state.kicks.empty()) first.delay = state.kicks.front().due;
        if (trace.kicks.empty()) continue;
        first.acted = {0.8, velocity, ball_B};
        first.kicked = trace.kicks.front();
        first.heading = robot.pose.heading;
        EXPECT_EQ(first.delay / (20 * ms), k) << "it acts in the tick in which it is due";
        return first;
    }
    return std::nullopt;
}

TEST(LearnedKick, InTheWorldIsOfTheNetworksDistributions) {
    const LearnedKicker kicker(plantedKicker(0.1));
    std::vector<double> delays, speeds, directions;
    double hits = 0, expected = 0;
    for (std::uint64_t seed = 1; seed <= 800; ++seed) {
        const auto first = firstKick(seed);
        ASSERT_TRUE(first);
        delays.push_back(kicker.delay(first->commanded).probabilityBelow(0, toSeconds(first->delay)));
        const ReadingDistribution departure = kicker.departure(first->acted);
        expected += departure.probability();
        if (!first->kicked.hit) continue;
        ++hits;
        const Point v = first->kicked.speed_W;
        speeds.push_back(departure.probabilityBelow(0, length(v)));
        directions.push_back(departure.probabilityBelow(1, wrapAngle(direction(v) - first->heading) - 0.1));
    }
    EXPECT_LT(kolmogorov(delays), 1.63);
    EXPECT_LT(kolmogorov(speeds), 1.63);
    EXPECT_LT(kolmogorov(directions), 1.63);
    EXPECT_NEAR(hits, expected, 3 * std::sqrt(expected * 0.25));
    EXPECT_GT(hits, 100);
}

TEST(LearnedKick, IsTheSameAgainFromAnyCopyOfTheState) {
    const Scenario scenario = kickingScenario(11, 900 * ms);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::string kept;
    std::vector<StateHash> hashes;
    for (int k = 0; k < 60; ++k) {
        step(scenario, state, buffers);
        hashes.push_back(hashOf(state));
        if (k == 2) kept = stateBytes(state);
    }
    const auto copy = parseState(kept, "kept");
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->kicks.size(), 1u) << "on its way";
    WorldState again = *copy;
    for (std::size_t k = 3; k < 60; ++k) {
        again = stepped(scenario, std::move(again));
        ASSERT_EQ(hashOf(again), hashes[k]) << k;
    }
    WorldState other = kickingScenario(12, 900 * ms).initialState();
    const WorldState first = stepped(kickingScenario(11, 900 * ms), kickingScenario(11, 900 * ms).initialState());
    other = stepped(kickingScenario(12, 900 * ms), std::move(other));
    EXPECT_NE(other.kicks.at(0).due, first.kicks.at(0).due) << "another seed, another delay";
}

TEST(LearnedKick, KicksOneAfterTheOtherAreDrawnAnewAndRecharge) {
    const Scenario scenario = kickingScenario(5, 2000 * ms);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::vector<std::int64_t> acted;
    std::vector<Nanoseconds> delays;
    for (int k = 0; k < 110; ++k) {
        StepTrace trace;
        const std::size_t before = state.kicks.size();
        step(scenario, state, buffers, {}, &trace);
        if (state.kicks.size() > before) delays.push_back(state.kicks.back().due - k * 20 * ms);
        if (!trace.kicks.empty()) acted.push_back(k);
    }
    ASSERT_GE(acted.size(), 4u);
    for (std::size_t i = 1; i < acted.size(); ++i) EXPECT_GE(acted[i] - acted[i - 1], 15);
    std::ranges::sort(delays);
    EXPECT_EQ(std::adjacent_find(delays.begin(), delays.end()), delays.end());
    EXPECT_GE(delays.size(), 5u);
}

TEST(LearnedKick, ReachesNoBallBeyondWhatWasSeen) {
    RobotType type = squareRobot();
    type.manipulators = {{.name = "kicker", .learned = std::make_shared<const LearnedKicker>(plantedKicker())}};
    SmallWorld world;
    world.robot(type, {}, std::make_shared<const DrivingKicker>(0), ideal());
    world.object(ballType(), {0.8, 0, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 20);
    EXPECT_EQ(state.objects[0].pose, (Pose{0.8, 0, 0}));
    EXPECT_TRUE(state.kicks.empty());
}

}  // namespace
}  // namespace mrose
