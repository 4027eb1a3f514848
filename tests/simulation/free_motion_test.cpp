// Without touch a robot moves exactly as its model predicts, at its own period and phase, whoever else is there.
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/small_world.h"

namespace mrose {
namespace {

constexpr Nanoseconds ms = 1'000'000;

/// Drives the scenario and compares, at the end of each control period of each robot, with the model asked beside it.
void expectPredictions(const Scenario& scenario, int ticks, double tolerance) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::vector<Pose> expected(state.robots.size());
    std::vector<bool> known(state.robots.size());
    int compared = 0;
    for (int k = 0; k < ticks; ++k) {
        const WorldState before = state;
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        for (std::size_t i = 0; i < state.robots.size(); ++i) {
            ASSERT_FALSE(trace.robots[i].touched);
            if (before.robots[i].nextControl != before.tick) continue;
            const RobotState& r = before.robots[i];
            if (known[i]) {
                EXPECT_NEAR(r.pose.x, expected[i].x, tolerance);
                EXPECT_NEAR(r.pose.y, expected[i].y, tolerance);
                EXPECT_NEAR(r.pose.heading, expected[i].heading, tolerance);
                ++compared;
            }
            MotionInput input{scenario.commandsOf(state, i),
                              scenario.scene().timeOf(before.tick),
                              {r.velocity_B.x, r.velocity_B.rotation}};
            if (r.segment.hasUnperturbed) input.unperturbed = r.segment.unperturbed;
            expected[i] = r.pose * scenario.scene().modelOf(i).predictOne(input).increment;
            known[i] = true;
        }
    }
    EXPECT_GT(compared, ticks / 10);
}

TEST(FreeMotion, IsTheModelsPrediction) {
    SmallWorld world;
    KinematicParameters lagged;
    lagged.v = {0.13, 0.2, 0.9, 0.01, 0.8, 1.5};
    lagged.w = {0.07, 0.1, 1.1, 0, 3, 8};
    const auto wild = std::make_shared<const RandomCommands>(-1, 1, 4);
    world.robot(squareRobot(), {0, 0, 1}, wild, ideal());
    world.robot(discRobot(), {50, 0, 2}, wild, paperFormModel(), 3);
    world.robot(squareRobot(), {0, 50, 3}, wild, std::make_shared<const KinematicModel>(lagged, 200 * ms), 1);
    world.robot(squareRobot(), {50, 50, 4}, wild, std::make_shared<const KinematicModel>(lagged, 20 * ms), 2);
    expectPredictions(world.scenario(), 2000, 1e-12);
}

TEST(FreeMotion, IsTheModelsPredictionNearOtherBodiesToo) {
    // Two robots, a box and a wall so near that the contact solver is asked in every tick, and nothing touches.
    SmallWorld world(walledField(100, 10));
    const auto ahead = std::make_shared<const Told>(Command{0.3, 0});
    const double gap = 0.003;
    world.robot(squareRobot(), {1, 0.225 + gap, 0}, ahead, paperFormModel());
    world.robot(squareRobot(), {1, 3 * 0.225 + 2 * gap, 0}, ahead, paperFormModel());
    world.object(boxType(0.3), {4, 4 * 0.225 + 3 * gap + 0.15, 0});
    expectPredictions(world.scenario(), 1000, 1e-12);
}

TEST(FreeMotion, CommandTakesEffectAfterItsDeadTimeAlsoBetweenTicks) {
    KinematicParameters late;
    late.v.deadTime = 0.133;  // no multiple of tick or period
    SmallWorld world;
    world.robot(squareRobot(), {}, std::make_shared<const Told>(Command{0.5, 0}),
                std::make_shared<const KinematicModel>(late));
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 5);
    EXPECT_EQ(state.robots[0].pose.x, 0);
    run(scenario, state, 5);
    EXPECT_NEAR(state.robots[0].pose.x, 0.5 * (0.2 - 0.133), 1e-15);
    run(scenario, state, 5);
    EXPECT_NEAR(state.robots[0].pose.x, 0.5 * (0.3 - 0.133), 1e-15);
}

TEST(FreeMotion, RobotStandsUntilItsFirstControlInstantAndKeepsItsOwnPhase) {
    SmallWorld world;
    for (std::int64_t phase = 0; phase < 5; ++phase)
        world.robot(squareRobot(), {0, 3.0 * static_cast<double>(phase), 0},
                    std::make_shared<const Told>(Command{1, 0}), ideal(), phase);
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    for (std::size_t phase = 0; phase < 5; ++phase) {
        const RobotState& robot = state.robots[phase];
        run(scenario, state, phase == 0 ? 55 : 1);  // to its twelfth control instant
        EXPECT_EQ(robot.nextControl, state.tick);
        EXPECT_NEAR(robot.pose.x, 1.1, 1e-12) << phase;
    }
    EXPECT_NEAR(state.robots[0].pose.x, 1.1 + 4 * 0.02, 1e-12);
}

TEST(FreeMotion, MotionNoiseHasTheStatedSpread) {
    RobotType noisy = squareRobot();
    noisy.motionNoise = {0.1, 0.2, 0.3};
    SmallWorld world;
    const int robots = 2000;
    const auto model = ideal();
    for (int i = 0; i < robots; ++i)
        world.robot(noisy, {0, 3.0 * i, 0}, std::make_shared<const Told>(Command{1, 1}), model);
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 5);
    double meanTurn = 0, squareTurn = 0;
    for (const RobotState& robot : state.robots) {
        meanTurn += robot.pose.heading / robots;
        squareTurn += robot.pose.heading * robot.pose.heading / robots;
    }
    const double expected = std::hypot(0.2 * 0.1, 0.3 * 0.1);
    EXPECT_NEAR(meanTurn, 0.1, 4 * expected / std::sqrt(robots));
    EXPECT_NEAR(std::sqrt(squareTurn - meanTurn * meanTurn) / expected, 1, 4 / std::sqrt(2.0 * robots));
}

class Broken final : public MotionModel {
public:
    Nanoseconds period() const override { return 100 * ms; }
    Nanoseconds memory() const override { return 0; }
    void predict(std::span<const MotionInput> /*inputs*/, std::span<MotionStep> steps) const override {
        for (MotionStep& step : steps) step = {{std::nan(""), 0, 0}, {}, {}};
    }
};

TEST(FreeMotion, ModelWithoutAFinitePredictionIsNamedAndItsRobotStands) {
    SmallWorld world;
    world.robot(squareRobot(), {1, 2, 3}, std::make_shared<const Told>(Command{1, 0}),
                std::make_shared<const Broken>());
    const Scenario scenario = world.scenario();
    StepTrace trace;
    const WorldState state = stepped(scenario, scenario.initialState(), {}, &trace);
    ASSERT_EQ(trace.faults.size(), 1u);
    EXPECT_EQ(trace.faults[0].robot, 0u);
    EXPECT_EQ(trace.faults[0].what, "its motion model predicted no finite motion");
    EXPECT_EQ(state.robots[0].pose, (Pose{1, 2, 3}));
}

}  // namespace
}  // namespace mrose
