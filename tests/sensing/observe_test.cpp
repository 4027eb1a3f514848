#include "simulation/observe.h"

#include <set>

#include "sensing/perceiving.h"

namespace mrose {
namespace {

Perception everything() {
    Perception perception;
    perception.self = {{0.05, 0.05, 0.03}, {0.06, 0.06, 0.03}, 1.5, 100'000'000, 0.05, 0.01, 0.5};
    perception.objects = {.bearingNoise = 0.02,
                          .rangeNoise = 0.03,
                          .rangeNoiseSlope = 0.02,
                          .bearingBias = 0.02,
                          .latency = 80'000'000,
                          .dropOut = 0.05,
                          .occlusion = true};
    perception.robots = perception.objects;
    perception.velocityNoise = 0.02;
    perception.rotationNoise = 0.05;
    return perception;
}

SmallWorld threeRobots(const Perception& perception) {
    SmallWorld world(walledField(6, 4));
    world.robot(perceiving(perception), {1, 1, 0.3}, std::make_shared<const Told>(Command{0.3, 0.4}), ideal())
        .robot(perceiving(perception), {3, 2, 2}, std::make_shared<const Told>(Command{0.2, -0.5}), ideal(), 2)
        .robot(perceiving(perception), {5, 3, -1}, still(), ideal(), 1)
        .object(ballType(), {2, 2, 0});
    return world;
}

/// All that robots get to see in some seconds.
std::vector<Observation> observations(const Scenario& scenario, std::uint64_t seed) {
    WorldState state = scenario.initialState(seed);
    StepBuffers buffers;
    std::vector<Observation> result;
    for (int i = 0; i < 150; ++i) {
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        for (const StepTrace::Robot& robot : trace.robots)
            if (robot.observed) result.push_back(robot.observation);
    }
    return result;
}

TEST(Observe, WithEverythingZeroIsExactAndKnowsNoSeed) {
    const Scenario scenario = threeRobots({}).scenario();
    for (const std::uint64_t seed : {1, 2}) {
        WorldState state = scenario.initialState(seed);
        run(scenario, state, 37);
        Observation now;
        perceive(scenario, state, 1, now);
        const RobotState& self = state.robots[1];
        EXPECT_EQ(now.robot, 1u);
        EXPECT_TRUE(now.localised());
        EXPECT_EQ(now.self(), self.pose);
        EXPECT_EQ(now.time, 37 * 20'000'000);
        EXPECT_EQ(now.selfMeasured(), now.time);
        EXPECT_EQ(now.velocity(), (Velocity{self.velocity_B.x, self.velocity_B.rotation}));
        ASSERT_EQ(now.robots().size(), 2u);
        EXPECT_EQ(now.robots()[0].index, 0u);
        EXPECT_EQ(now.robots()[1].index, 2u);
        ASSERT_EQ(now.objects().size(), 1u);
        const auto expectAt = [&](const SeenBody& body, const Pose& truth) {
            EXPECT_LT(distance(body.position_B, position(relative(self.pose, truth))), 1e-12);
            EXPECT_EQ(body.measured, now.time);
        };
        expectAt(now.robots()[0], state.robots[0].pose);
        expectAt(now.robots()[1], state.robots[2].pose);
        expectAt(now.objects()[0], state.objects[0].pose);
    }
}

TEST(Observe, OdometryHasTheStatedDeviations) {
    Perception perception;
    perception.velocityNoise = 0.02;
    perception.rotationNoise = 0.07;
    const Scenario scenario = SmallWorld().robot(perceiving(perception), {}, still(), ideal()).scenario();
    SensorWatch watch(scenario, 41);
    watch.state().robots[0].velocity_B = {0.4, 0.1, -0.3};
    StandardNormals v, w, both;
    for (int i = 0; i < 20000; ++i) {
        const Velocity velocity = watch.next().velocity();
        v.add((velocity.v - 0.4) / 0.02);
        w.add((velocity.w + 0.3) / 0.07);
        both.add(((velocity.v - 0.4) / 0.02 + (velocity.w + 0.3) / 0.07) / std::sqrt(2));
    }
    v.expectStandard("v");
    w.expectStandard("w");
    both.expectStandard("v and w");
}

TEST(Observe, IsAFunctionOfScenarioSeedAndState) {
    const Scenario scenario = threeRobots(everything()).scenario(), again = threeRobots(everything()).scenario();
    EXPECT_EQ(observations(scenario, 5), observations(again, 5));
    EXPECT_NE(observations(scenario, 5), observations(scenario, 6));
}

/// The newcomer touches nothing and is seen by no robot: only it is new.
TEST(Observe, AnotherRobotDoesNotChangeTheNoiseOfOthers) {
    Perception perception = everything();
    perception.objects.occlusion = perception.robots.occlusion = false;
    SmallWorld world = threeRobots(perception);
    const std::vector<Observation> before = observations(world.scenario(), 7);
    world.robot(perceiving(perception), {5, 1, 0}, still(), ideal());
    std::vector<Observation> after = observations(world.scenario(), 7);
    std::erase_if(after, [](const Observation& o) { return o.robot == 3; });
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
        std::vector<SeenBody> others(after[i].robots().begin(), after[i].robots().end());
        std::erase_if(others, [](const SeenBody& body) { return body.index == 3; });
        EXPECT_TRUE(std::ranges::equal(others, before[i].robots()));
        EXPECT_TRUE(std::ranges::equal(after[i].objects(), before[i].objects()));
        EXPECT_EQ(after[i].self(), before[i].self());
        EXPECT_EQ(after[i].velocity(), before[i].velocity());
    }
}

TEST(Observe, RobotsDrawIndependently) {
    Perception perception;
    perception.self.noise = {0.1, 0.1, 0.1};
    SmallWorld world;
    const Scenario scenario = world.robot(perceiving(perception), {}, still(), ideal())
                                  .robot(perceiving(perception), {}, still(), ideal())
                                  .scenario();
    SensorWatch first(scenario, 8, 0), second(scenario, 8, 1);
    StandardNormals both;
    for (int i = 0; i < 20000; ++i) both.add((first.next().self().x + second.next().self().x) / (0.1 * std::sqrt(2)));
    both.expectStandard("both");
}

TEST(Observe, GivesFreshRandomBitsEveryTime) {
    const Scenario scenario = threeRobots({}).scenario();
    std::set<std::uint64_t> bits;
    int ones = 0, count = 0;
    for (const Observation& o : observations(scenario, 9)) {
        bits.insert(o.noise);
        for (int i = 0; i < 64; ++i) ones += static_cast<int>(o.noise >> i & 1);
        ++count;
    }
    EXPECT_EQ(bits.size(), static_cast<std::size_t>(count));
    expectRate(ones, 64 * count, 0.5);
}

/// Sensors that are late know nothing of what has happened since.
TEST(Observe, PresentIsHiddenFromSensorsThatAreLate) {
    const Scenario scenario = threeRobots(everything()).scenario();
    WorldState state = scenario.initialState(3);
    run(scenario, state, 50);
    WorldState changed = state;
    for (RobotState& robot : changed.robots) robot.pose = robot.pose * Pose{0.4, 0.3, 1};
    changed.objects[0].pose.x += 0.5;
    for (std::size_t robot = 0; robot < 3; ++robot) {
        Observation truth, after;
        perceive(scenario, state, robot, truth);
        perceive(scenario, changed, robot, after);
        EXPECT_EQ(after, truth);
    }
}

TEST(Observe, BodiesOutOfSightDoNotMatter) {
    Perception perception = everything();
    perception.self.latency = perception.objects.latency = perception.robots.latency = 0;
    perception.objects.fieldOfView = perception.robots.fieldOfView = 1.5;
    const Scenario scenario = threeRobots(perception).scenario();
    WorldState state = scenario.initialState(3);
    Observation before, after;
    perceive(scenario, state, 2, before);
    WorldState changed = scenario.initialState(3);
    // All of them are behind robot 2, before and after.
    changed.robots[0].pose = {1, 3, 1};
    changed.objects[0].pose = {3, 3.5, 0};
    perceive(scenario, changed, 2, after);
    EXPECT_TRUE(before.robots().empty() && before.objects().empty());
    EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace mrose
