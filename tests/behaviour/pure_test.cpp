// Controllers remember in the state alone: whoever restores one gets the same decisions and the same memory.
#include <cstring>

#include <gtest/gtest.h>

#include "behaviour/chase_ball.h"
#include "behaviour/command_player.h"
#include "behaviour/dynamic_window.h"
#include "behaviour/free_ball.h"
#include "behaviour/go_to_pose.h"
#include "behaviour/navigate.h"
#include "behaviour/small_field.h"
#include "behaviour/team_player.h"
#include "behaviour/wander.h"
#include "scenario/obstacle_sensors.h"
#include "sensing/bumpers.h"
#include "sensing/laser.h"
#include "sensing/sonar_ring.h"
#include "simulation/observe.h"
#include "world/state_bytes.h"

namespace mrose {
namespace {

RobotType sensingRobot() {
    RobotType type = guideRobot(cameras());
    type.manipulators.push_back({.name = "kicker", .position = {0.17, 0}, .width = 0.25});
    Laser::Options laser;
    laser.first = -1.5;
    laser.step = 0.05;
    laser.beams = 61;
    laser.errors.range = 4;
    SonarRing::Options sonars;
    for (int i = 0; i < 8; ++i) sonars.sonars.push_back({0, 0, 0.785 * i});
    sonars.cone = 0.5;
    sonars.errors.range = 3;
    type.sensors = {std::make_shared<const Laser>(SensorTraits{"laser", 100'000'000}, laser),
                    std::make_shared<const SonarRing>(SensorTraits{"sonar", 200'000'000}, sonars),
                    std::make_shared<const Bumpers>(SensorTraits{"bumpers", 0},
                                                    std::vector<Bumpers::Segment>{{-1, 2}, {1, 4.283}})};
    return type;
}

constexpr Point pitch{8, 4};  // m

/// With the other of them, and with a robot that tells nothing.
TeamPlayer::Options inATeam() {
    TeamPlayer::Options options;
    options.chase.target = {6, 2};
    options.team = {{3, "3"}, {4, "4"}, {6, "6"}};
    return options;
}

std::vector<std::shared_ptr<const Controller>> builtIn() {
    std::vector<StampedCommand> script;
    for (int i = 0; i < 300; ++i) script.push_back({i * 77'000'000LL - 400'000'000, {0.3, i % 7 * 0.2 - 0.6}});
    const auto walls = floorPlanOf(walledField(pitch.x, pitch.y));
    return {
        std::make_shared<const CommandPlayer>(script),
        std::make_shared<const GoToPose>(
            GoToPose::Options{.targets = {{1, 1, 0}, {5, 3, 2}}, .loop = true, .backwards = true}),
        std::make_shared<const ChaseBall>(ChaseBall::Options{.target = {6, 2}}),
        std::make_shared<const ChaseBall>(ChaseBall::Options{.target = {0, 2}}),
        std::make_shared<const TeamPlayer>(inATeam()),
        std::make_shared<const Wander>(Wander::Options{}),
        std::make_shared<const TeamPlayer>(inATeam()),
        std::make_shared<const ChaseBall>(
            ChaseBall::Options{.target = {6, 2}, .stroke = WallStroke::Options{}, .walls = walls}),
        std::make_shared<const FreeBall>(FreeBall::Options{.walls = walls}),
        std::make_shared<const Navigate>(Navigate::Options{
            .target = {1, 2.5, 1},
            .method = {.repair = Repair::temporaryTarget},
            .choice = {.methods = {TeamMethod{}, TeamMethod{.lowestFirst = false}}, .time = nullptr, .inputs = {}}}),
        std::make_shared<const DynamicWindow>(DynamicWindow::Options{
            .waypoints = {{1, 3}, {5, 1}}, .loop = true, .sensors = obstacleSensors(sensingRobot())})};
}

Scenario allRobots() {
    SmallWorld world(walledField(pitch.x, pitch.y));
    const RobotType type = sensingRobot();
    const auto controllers = builtIn();
    for (std::size_t i = 0; i < controllers.size(); ++i)
        world.robot(type, {0.6 + 0.65 * static_cast<double>(i), i % 2 == 0 ? 1.0 : 3.0, 1.0 * static_cast<double>(i)},
                    controllers[i], noisyDrive(), static_cast<std::int64_t>(i));
    world.object(ballType(), {3, 2, 0}, {0.4, 0.1, 0});
    return world.scenario();
}

TEST(Pure, EveryTickSteppedTwiceFromOneStateGivesTheSameMemory) {
    const Scenario scenario = allRobots();
    WorldState state = scenario.initialState();
    StepBuffers buffers, others;
    run(scenario, state, 500);
    for (int tick = 0; tick < 1500; ++tick) {
        WorldState again = state;
        StepTrace first, second;
        step(scenario, state, buffers, {}, &first);
        step(scenario, again, others, {}, &second);
        ASSERT_EQ(stateBytes(state), stateBytes(again)) << tick;
        ASSERT_EQ(state.memory, again.memory) << tick;
        for (std::size_t i = 0; i < state.robots.size(); ++i)
            ASSERT_TRUE(first.robots[i].decision.sameOrders(second.robots[i].decision));
    }
}

/// Another object of the same class, in another run, over the same state.
TEST(Pure, ControllersThemselvesRememberNothing) {
    const Scenario one = allRobots(), two = allRobots();
    WorldState state = one.initialState();
    run(one, state, 700);
    WorldState other = state;
    run(one, state, 500);
    run(two, other, 500);
    EXPECT_EQ(stateBytes(state), stateBytes(other));
}

/// No byte of the memory is left as it happened to be.
TEST(Pure, MemoryHoldsNothingButWhatIsTold) {
    const Scenario scenario = allRobots();
    WorldState state = scenario.initialState();
    run(scenario, state, 700);
    for (std::size_t i = 0; i < state.robots.size(); ++i) {
        std::vector<std::byte> first(scenario.controller(i).memorySize()), second(first.size());
        std::memcpy(first.data(), scenario.memoryOf(std::as_const(state), i).data(), first.size());
        second = first;
        Observation observation;
        SensingBuffers sensing;
        observe(scenario, state, i, scenario.sensorMemory(state, i), sensing, observation);
        Decision decision, again;
        scenario.controller(i).decide(observation, first, decision);
        // What lies on the stack must not matter.
        volatile double rubbish[512];
        for (double i2 = 0; volatile double& r : rubbish) r = i2 += 1.7;
        scenario.controller(i).decide(observation, second, again);
        EXPECT_EQ(first, second) << i;
        EXPECT_TRUE(decision.sameOrders(again)) << i;
    }
}

}  // namespace
}  // namespace mrose
