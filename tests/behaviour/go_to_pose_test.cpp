#include "behaviour/go_to_pose.h"

#include <numbers>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"

namespace mrose {
namespace {

double off(const WorldState& state, const Pose& goal) {
    return distance(position(state.robots[0].pose), position(goal));
}
double turned(const WorldState& state, const Pose& goal) {
    return std::abs(wrapAngle(state.robots[0].pose.heading - goal.heading));
}
bool rests(const WorldState& state, double within = 1e-3) {
    const Twist& velocity = state.robots[0].velocity_B;
    return std::abs(velocity.x) < within && std::abs(velocity.rotation) < 2 * within;
}

Scenario alone(const RobotType& type, const Pose& start, const GoToPose::Options& options, std::int64_t phase = 0,
               std::shared_ptr<const MotionModel> drive = noisyDrive()) {
    return SmallWorld(walledField(9, 5))
        .robot(type, start, std::make_shared<const GoToPose>(options), std::move(drive), phase)
        .scenario();
}

/// One that knows where it is and has no noise.
Scenario exact(const Pose& start, const GoToPose::Options& options, std::int64_t phase = 0) {
    return alone(guideRobot({}), start, options, phase, lateDrive());
}

TEST(GoToPose, ArrivesWithinItsTolerancesFromEverywhereAndStays) {
    for (const bool backwards : {false, true})
        for (std::int64_t i = 0; i < 100; ++i) {
            const Pose goal = somewhere(71, 1000 + i, 9, 5);
            const Scenario scenario = exact(somewhere(71, i, 9, 5), {.targets = {goal}, .backwards = backwards}, i % 5);
            WorldState state = scenario.initialState();
            run(scenario, state, 40 * ticksPerSecond);
            EXPECT_LT(off(state, goal), 0.05) << i;
            EXPECT_LT(turned(state, goal), 0.1) << i;
            EXPECT_TRUE(rests(state)) << i;
            const Pose arrived = state.robots[0].pose;
            run(scenario, state, 20 * ticksPerSecond);
            EXPECT_EQ(state.robots[0].pose, arrived) << i;
        }
}

/// Its camera is off by some centimetres, and so is it; most of the time it rests all the same.
TEST(GoToPose, ArrivesByNoisyCamerasAsFarAsTheyTell) {
    int resting = 0, far = 0;
    for (std::int64_t i = 0; i < 100; ++i) {
        const Pose goal = somewhere(72, 1000 + i, 9, 5);
        const Scenario scenario = alone(guideRobot(cameras()), somewhere(72, i, 9, 5), {.targets = {goal}}, i % 5);
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(i));
        run(scenario, state, 40 * ticksPerSecond);
        resting += rests(state) ? 1 : 0;
        EXPECT_LT(off(state, goal), 0.25) << i;
        far += off(state, goal) > 0.12 ? 1 : 0;
        run(scenario, state, 20 * ticksPerSecond);
        EXPECT_LT(off(state, goal), 0.25) << i;
    }
    EXPECT_GE(resting, 85);
    EXPECT_LE(far, 10);
}

TEST(GoToPose, VisitsItsTargetsInOrderAndAgainIfItLoops) {
    const std::vector<Pose> targets{{2, 2, 0}, {4, 3, 1.5}, {6, 2, 3}};
    for (const bool loop : {false, true}) {
        const Scenario scenario = exact({1, 1, 0}, {.targets = targets, .loop = loop});
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        std::vector<std::size_t> visited;
        for (int tick = 0; tick < 90 * ticksPerSecond; ++tick) {
            step(scenario, state, buffers);
            for (std::size_t i = 0; i < targets.size(); ++i)
                if (off(state, targets[i]) < 0.05 && turned(state, targets[i]) < 0.1 && rests(state, 0.05) &&
                    (visited.empty() || visited.back() != i))
                    visited.push_back(i);
        }
        ASSERT_GE(visited.size(), 3u);
        for (std::size_t i = 0; i < visited.size(); ++i) EXPECT_EQ(visited[i], i % 3);
        EXPECT_EQ(visited.size() > 3, loop);
    }
}

TEST(GoToPose, GoesTailFirstWhereItMay) {
    const Pose start{5, 2.5, 0}, goal{4, 2.5, 0};
    double seconds[2] = {};
    for (const bool backwards : {false, true}) {
        const Scenario scenario = exact(start, {.targets = {goal}, .backwards = backwards});
        WorldState state = scenario.initialState();
        while ((off(state, goal) > 0.05 || !rests(state) || turned(state, goal) > 0.1) &&
               state.tick < 60 * ticksPerSecond) {
            run(scenario, state, 1);
            EXPECT_TRUE(!backwards || turned(state, goal) < 0.2);
        }
        seconds[backwards ? 1 : 0] = toSeconds(scenario.scene().timeOf(state.tick));
    }
    EXPECT_LT(seconds[1], 0.6 * seconds[0]);
}

/// Two that want to change places meet head on.
TEST(GoToPose, PassesARobotThatComesItsWay) {
    const Pose west{1, 2.5, 0}, east{8, 2.5, 0}, back{0, 0, std::numbers::pi};
    RobotType type = guideRobot({});
    const Scenario scenario =
        SmallWorld(walledField(9, 5))
            .robot(type, west, std::make_shared<const GoToPose>(GoToPose::Options{.targets = {east}}), noisyDrive())
            .robot(type, east * back, std::make_shared<const GoToPose>(GoToPose::Options{.targets = {west * back}}),
                   noisyDrive(), 2)
            .scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    while (state.tick < 60 * ticksPerSecond) {
        step(scenario, state, buffers, {}, &trace);
        EXPECT_TRUE(trace.contacts.empty()) << state.tick;
    }
    EXPECT_LT(distance(position(state.robots[0].pose), position(east)), 0.1);
    EXPECT_LT(distance(position(state.robots[1].pose), position(west)), 0.1);
}

TEST(GoToPose, StandsUntilItKnowsWhereItIs) {
    Perception perception;
    perception.self.dropOut = 1;
    const Scenario scenario = alone(guideRobot(perception), {2, 2, 0}, {.targets = {{4, 2, 0}}});
    WorldState state = scenario.initialState();
    run(scenario, state, 5 * ticksPerSecond);
    EXPECT_EQ(state.robots[0].pose, (Pose{2, 2, 0}));
}

TEST(GoToPose, ShowsGoalDistanceAndState) {
    const Pose goal{4, 2, 0};
    const Scenario scenario = exact({2, 2, 0}, {.targets = {goal}});
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    step(scenario, state, buffers, {}, &trace);
    const std::vector<Annotation>& shown = trace.robots[0].decision.annotations;
    ASSERT_EQ(shown.size(), 3u);
    EXPECT_EQ(shown[0].points, std::vector<Point>{position(goal)});
    EXPECT_NEAR(shown[1].value, 2, 1e-12);
    EXPECT_EQ(shown[2].text, "approaching");
}

/// Round a pillar that stands between, and through a door; without knowing them it runs into both.
TEST(GoToPose, KeepsOffWallsThatItKnows) {
    Environment rooms = walledField(9, 5);
    const auto wall = [](const std::string& name, Polygon corners) {
        ShapePart part;
        part.polygon = std::move(corners);
        return Obstacle{name, Shape::fromParts(name, {part}), {}};
    };
    rooms.obstacles.push_back(wall("pillar", {{2.3, 2.2}, {2.7, 2.2}, {2.7, 2.7}, {2.3, 2.7}}));
    rooms.obstacles.push_back(wall("south of the door", {{5, 0}, {5.1, 0}, {5.1, 2}, {5, 2}}));
    rooms.obstacles.push_back(wall("north of the door", {{5, 3}, {5.1, 3}, {5.1, 5}, {5, 5}}));
    const std::vector<Pose> targets{{4.2, 2.5, 0}, {6.5, 2.5, 0}, {4.2, 2.5, 0}, {1, 2.5, 0}};
    for (const bool knows : {true, false}) {
        int touching = 0, arrived = 0;
        for (std::uint64_t seed = 0; seed < 10; ++seed) {
            GoToPose::Options options{.targets = targets, .tolerance = 0.15, .radius = 0.31};
            if (knows) options.walls = floorPlanOf(rooms);
            const Scenario scenario = SmallWorld(rooms)
                                          .robot(guideRobot(cameras()), {1, 2.5, 0.6 * static_cast<double>(seed)},
                                                 std::make_shared<const GoToPose>(options), noisyDrive())
                                          .scenario();
            WorldState state = scenario.initialState(seed);
            StepBuffers buffers;
            StepTrace trace;
            for (int tick = 0; tick < 120 * ticksPerSecond; ++tick) {
                step(scenario, state, buffers, {}, &trace);
                touching += trace.contacts.empty() ? 0 : 1;
            }
            arrived += off(state, targets.back()) < 0.5 ? 1 : 0;
        }
        if (knows) {
            EXPECT_LT(touching, 10 * 120 * ticksPerSecond / 200);
            EXPECT_EQ(arrived, 10);
        } else {
            EXPECT_GT(touching, 10 * 120 * ticksPerSecond / 50);
        }
    }
}

TEST(GoToPose, GoesRoundABoxButNotRoundTheBall) {
    for (const bool ball : {false, true}) {
        const Scenario scenario =
            SmallWorld(walledField(9, 5))
                .robot(guideRobot({}), {1, 2.5, 0},
                       std::make_shared<const GoToPose>(GoToPose::Options{.targets = {{8, 2.5, 0}}, .ball = ball}),
                       lateDrive())
                .object(boxType(0.3, 500), {4.5, 2.5, 0})
                .scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        int touching = 0;
        for (int tick = 0; tick < 40 * ticksPerSecond; ++tick) {
            step(scenario, state, buffers, {}, &trace);
            touching += trace.contacts.empty() ? 0 : 1;
        }
        EXPECT_EQ(touching > 0, ball);
        if (!ball) {
            EXPECT_LT(off(state, {8, 2.5, 0}), 0.1);
        }
    }
}

}  // namespace
}  // namespace mrose
