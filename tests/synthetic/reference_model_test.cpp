#include "synthetic/reference_model.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "behaviour/command_player.h"
#include "simulation/small_world.h"
#include "support/units.h"
#include "synthetic/drive_patterns.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

std::shared_ptr<const MotionModel> reference(Nanoseconds period = 100 * ms) {
    return std::make_shared<const ReferenceModel>(period);
}

/// What a robot is told: what repeats the command in force is told to nobody.
std::vector<StampedCommand> changesOf(const std::vector<StampedCommand>& all) {
    std::vector<StampedCommand> changes;
    for (const StampedCommand& one : all)
        if (changes.empty() || !identical(changes.back().command, one.command)) changes.push_back(one);
    return changes;
}

/// Random driving, with commands of the log generator's uneven instants.
std::vector<StampedCommand> drive(double seconds, std::uint32_t which) {
    return changesOf(patternCommands(DrivePattern::random, seconds, 3, which));
}

Scenario driven(const std::vector<StampedCommand>& commands, std::shared_ptr<const MotionModel> model,
                const Pose& start = {}, std::int64_t phase = 0) {
    return SmallWorld()
        .robot(discRobot(), start, std::make_shared<const CommandPlayer>(commands), std::move(model), phase)
        .scenario();
}

TEST(ReferenceModel, IsTheReferenceRobotDrivenByItself) {
    for (const auto& [period, which] : {std::pair{100 * ms, 0u}, {40 * ms, 1u}, {200 * ms, 2u}}) {
        const std::vector<StampedCommand> commands = drive(60, which);
        const Pose start{1, 2, 0.5};
        const Scenario scenario = driven(commands, reference(period), start);
        WorldState world = scenario.initialState(11 + which);
        const ReferenceRobot robot(ReferenceModel::robotSeed({world.seed, 0, 0, 0}));
        ReferenceRobotState alone = robot.start(start);
        std::size_t next = 0;
        double driven = 0;
        while (world.tick < 60 * 50) {
            run(scenario, world, static_cast<int>(scenario.periodOf(0).ticks));
            const Pose before = alone.pose;
            for (; alone.time < scenario.scene().timeOf(world.tick); alone = robot.next(alone))
                for (; next < commands.size() && commands[next].time <= alone.time; ++next)
                    alone = robot.issue(alone, commands[next].command);
            driven += distance(position(before), position(alone.pose));
            const RobotState& r = world.robots[0];
            ASSERT_NEAR(r.pose.x, alone.pose.x, 1e-9) << world.tick;
            ASSERT_NEAR(r.pose.y, alone.pose.y, 1e-9) << world.tick;
            ASSERT_NEAR(r.pose.heading, alone.pose.heading, 1e-9) << world.tick;
            ASSERT_NEAR(r.velocity_B.x, alone.velocity.v, 1e-9) << world.tick;
            ASSERT_NEAR(r.velocity_B.rotation, alone.velocity.w, 1e-9) << world.tick;
        }
        EXPECT_GT(driven, 3);
    }
}

/// Four in a room too small for them.
Scenario crowdedRoom() {
    SmallWorld world(walledField(2.4, 2));
    const auto model = reference();
    for (std::uint32_t i = 0; i < 4; ++i)
        world.robot(discRobot(0.2, 7.5), {0.6 + 1.2 * (i % 2), 0.5 + 1.0 * (i / 2), 1.0 * i},
                    std::make_shared<const CommandPlayer>(drive(60, 10 + i)), model, i);
    world.object(ballType(), {1.2, 1, 0}, {0.5, 0.3, 0});
    return world.scenario();
}

TEST(ReferenceModel, IsRewoundFromEveryTickToTheSameBits) {
    const Scenario scenario = crowdedRoom();
    WorldState state = scenario.initialState();
    std::vector<WorldState> kept;
    for (int tick = 0; tick < 200; ++tick) {
        kept.push_back(state);
        run(scenario, state, 1);
    }
    for (const WorldState& from : kept) {
        WorldState again = from;
        run(scenario, again, static_cast<int>(state.tick - from.tick));
        ASSERT_EQ(stateBytes(again), stateBytes(state)) << from.tick;
    }
}

TEST(ReferenceModel, StaysSaneAmongWallsAndOthers) {
    const Scenario scenario = crowdedRoom();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    int touched = 0, stillTurning = 0;
    for (int tick = 0; tick < 60 * 50; ++tick) {
        step(scenario, state, buffers, {}, &trace);
        ASSERT_TRUE(trace.faults.empty());
        for (std::size_t i = 0; i < 4; ++i) {
            const RobotState& r = state.robots[i];
            touched += trace.robots[i].touched;
            ASSERT_GT(std::min(r.pose.x, r.pose.y), 0.19) << tick;
            ASSERT_LT(r.pose.x, 2.4 - 0.19) << tick;
            ASSERT_LT(r.pose.y, 2 - 0.19) << tick;
            // Faster than it drives it is where others run into it.
            ASSERT_LT(std::hypot(r.velocity_B.x, r.velocity_B.y), 1.2) << tick;
            ASSERT_LT(std::abs(r.velocity_B.rotation), 6) << tick;
            stillTurning += std::abs(r.velocity_B.rotation) > 0.05 || std::abs(r.velocity_B.x) > 0.02;
        }
    }
    EXPECT_GT(touched, 500) << "there was contact";
    EXPECT_GT(stillTurning, 4000) << "and driving";
}

TEST(ReferenceModel, AnotherSeedOrPlaceIsAnotherRobot) {
    SmallWorld world;
    const auto model = reference();
    const auto controller = std::make_shared<const Told>(Command{0.3, 0.5});
    world.robot(discRobot(), {}, controller, model).robot(discRobot(), {0, 5, 0}, controller, model);
    const Scenario scenario = world.scenario();
    std::set<double> ways;
    for (const std::uint64_t seed : {1, 2}) {
        WorldState state = scenario.initialState(seed);
        run(scenario, state, 300);
        for (const RobotState& robot : state.robots) {
            ways.insert(robot.pose.x);
            EXPECT_NEAR(robot.pose.x, state.robots[0].pose.x, 0.1);
        }
    }
    EXPECT_EQ(ways.size(), 4u);
}

/// By itself, without a state to remember in, and without a key.
TEST(ReferenceModel, BeginsAtTheSpeedThatItIsAskedFor) {
    CommandHistory history;
    history.issue(0, {0.3, 0.4});
    const MotionStep step = reference()->predictOne({&history, 10 * second, {0.28, 0.35}});
    EXPECT_NEAR(step.increment.x, 0.029, 0.003);
    EXPECT_NEAR(step.increment.heading, 0.037, 0.006);
    EXPECT_NEAR(step.velocity.v, 0.29, 0.02);
    const MotionStep stands = reference()->predictOne({&history, 0, {}});
    EXPECT_EQ(stands.increment, Pose{}) << "the command has just been issued";
    const MotionStep late = reference()->predictOne({&history, 250 * ms, {}});
    EXPECT_GT(late.increment.x, 0) << "what was on its way at the beginning arrives";
}

TEST(ReferenceModel, ExplainsWhatItRemembers) {
    const Scenario scenario = driven({{0, {0.2, 0}}}, reference());
    WorldState state = scenario.initialState();
    const MotionModel& model = scenario.scene().modelOf(0);
    EXPECT_TRUE(explained(model, scenario.motionMemory(state, 0)).empty());
    const auto entry = [&](const std::string& name) {
        for (const MemoryEntry& one : explained(model, scenario.motionMemory(state, 0)))
            if (one.name == name) return one;
        return MemoryEntry{};
    };
    run(scenario, state, 5);
    EXPECT_EQ(entry("synthetic").text, "reference robot");
    EXPECT_EQ(entry("commands_on_their_way").value, 1);
    run(scenario, state, 95);
    EXPECT_EQ(entry("commands_on_their_way").value, 0);
    EXPECT_EQ(entry("command_v").value, 0.2);
    EXPECT_EQ(entry("set_point_v").value, 0.2);
    EXPECT_NEAR(entry("left_wheel").value, 0.2, 0.02);
}

/// It pushes against a wall as fast as its wheels get in a period, and drives off once it is told to.
TEST(ReferenceModel, IsHeldByAWallAndDrivesOff) {
    SmallWorld world(walledField(3, 2));
    world.robot(
        discRobot(0.2, 7.5), {0.5, 1, 0},
        std::make_shared<const CommandPlayer>(std::vector<StampedCommand>{{0, {0.4, 0}}, {10 * second, {-0.4, 0}}}),
        reference());
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 10 * 50);
    EXPECT_NEAR(state.robots[0].pose.x, 2.8, 0.01);
    const auto& memory = as<ReferenceModel::Memory>(scenario.motionMemory(std::as_const(state), 0));
    EXPECT_LT(memory.robot.wheels[0].speed, 0.39) << "its wheels have stood with the body when the period began";
    run(scenario, state, 3 * 50);
    EXPECT_NEAR(state.robots[0].velocity_B.x, -0.4, 0.03);
    EXPECT_LT(state.robots[0].pose.x, 2.3);
}

}  // namespace
}  // namespace mrose
