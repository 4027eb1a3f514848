// Without touch a robot moves exactly as its model predicts, at its own period and phase, whoever else is there.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "behaviour/command_player.h"
#include "motion/noisy_model.h"
#include "simulation/predictions.h"
#include "simulation/shipped_crowd.h"
#include "simulation/small_world.h"
#include "support/units.h"

namespace mrose {
namespace {

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
    const FreePeriods found = expectPredictions(world.scenario(), 2000, 1e-12);
    EXPECT_GT(found.compared, 200);
    EXPECT_EQ(found.touched, 0);
}

TEST(FreeMotion, IsTheModelsPredictionNearOtherBodiesToo) {
    // Two robots, a box and a wall so near that the contact solver is asked in every tick, and nothing touches.
    SmallWorld world(walledField(100, 10));
    const auto ahead = std::make_shared<const Told>(Command{0.3, 0});
    const double gap = 0.003;
    world.robot(squareRobot(), {1, 0.225 + gap, 0}, ahead, paperFormModel());
    world.robot(squareRobot(), {1, 3 * 0.225 + 2 * gap, 0}, ahead, paperFormModel());
    world.object(boxType(0.3), {4, 4 * 0.225 + 3 * gap + 0.15, 0});
    const FreePeriods found = expectPredictions(world.scenario(), 1000, 1e-12);
    EXPECT_EQ(found.touched, 0);
    EXPECT_GE(found.near, 100);
}

/// Every network, model and outline that ships, in a crowd: whenever nothing touches a robot for a period.
TEST(FreeMotion, OfAllThatShipsIsItsModelsPredictionAmongOthers) {
    const FreePeriods found = expectPredictions(shippedCrowd(false), 20'000, 1e-12);
    EXPECT_GT(found.compared, 1000);
    EXPECT_GT(found.near, 200);
    EXPECT_GT(found.touched, 1000);
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

/// Forward speeds issued between ticks, 77 ms apart and a few nanoseconds more.
std::vector<StampedCommand> unevenScript() {
    std::vector<StampedCommand> script;
    for (std::int64_t i = 0; i < 60; ++i)
        script.push_back({77'000'013 * i + 5, {0.1 + 0.07 * static_cast<double>(i * i % 11), 0}});
    return script;
}

TEST(FreeMotion, CommandsIssuedBetweenTicksActTheirDeadTimeLater) {
    const std::vector<StampedCommand> script = unevenScript();
    KinematicParameters late;
    late.v.deadTime = 0.133000007;
    SmallWorld world;
    world.robot(squareRobot(), {}, std::make_shared<const CommandPlayer>(script),
                std::make_shared<const KinematicModel>(late), 3);
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 3);
    for (int period = 1; period <= 40; ++period) {
        run(scenario, state, 5);
        double way = 0;
        for (std::size_t i = 0; i < script.size(); ++i) {
            const double acts = toSeconds(script[i].time) + 0.133000007;
            const double ends = i + 1 < script.size() ? toSeconds(script[i + 1].time) + 0.133000007 : 1e9;
            const double now = 0.06 + 0.1 * period;
            way += script[i].command.v * std::max(0.0, std::min(ends, now) - std::max(acts, 0.06));
        }
        ASSERT_NEAR(state.robots[0].pose.x, way, 1e-12) << period;
    }
}

/// Compares the commands that it is shown, nanosecond by nanosecond about each issue, with those of a script.
class Reader final : public MotionModel {
public:
    explicit Reader(std::vector<StampedCommand> script) : script_(std::move(script)) {}
    Nanoseconds period() const override { return 100 * ms; }
    Nanoseconds lookBack() const override { return 450 * ms; }
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override {
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            compare(inputs[i]);
            steps[i] = {};
        }
    }
    mutable int compared = 0, wrong = 0;

private:
    Command expectedAt(Nanoseconds time) const {
        Command command;
        for (const StampedCommand& c : script_)
            if (c.time <= time) command = c.command;
        return command;
    }
    void compare(const MotionInput& input) const {
        for (const StampedCommand& c : script_)
            for (const Nanoseconds at : {c.time - 1, c.time, c.time + 1}) {
                if (at > input.start || at < input.start - lookBack()) continue;
                ++compared;
                if (!identical(input.commands.at(at), expectedAt(at))) ++wrong;
            }
        for (std::size_t i = 0; i < input.commands.size(); ++i) wrong += input.commands.issueTime(i) > input.start;
    }
    std::vector<StampedCommand> script_;
};

TEST(FreeMotion, ModelsReadEveryCommandFromTheNanosecondOfItsIssueAndNoneLater) {
    const std::vector<StampedCommand> script = unevenScript();
    const auto reader = std::make_shared<const Reader>(script);
    SmallWorld world;
    world.robot(squareRobot(), {}, std::make_shared<const CommandPlayer>(script), reader, 4);
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 240);
    EXPECT_GT(reader->compared, 600);
    EXPECT_EQ(reader->wrong, 0);
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
    SmallWorld world;
    const int robots = 2000;
    const auto noisy = withNoise(ideal(), {0.1, 0.2, 0.3});
    for (int i = 0; i < robots; ++i)
        world.robot(squareRobot(), {0, 3.0 * i, 0}, std::make_shared<const Told>(Command{1, 1}), noisy);
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
    Nanoseconds lookBack() const override { return 0; }
    void predict(std::span<const MotionInput> /*inputs*/, std::span<MotionStep> steps) const override {
        for (MotionStep& step : steps) step = {{std::nan(""), 0, 0}, {}};
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
