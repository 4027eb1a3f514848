#include "behaviour/memory_entries.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

#include "behaviour/chase_ball.h"
#include "behaviour/command_player.h"
#include "behaviour/go_to_pose.h"
#include "behaviour/small_field.h"
#include "behaviour/wander.h"
#include "support/observation_parts.h"

namespace mrose {
namespace {

std::map<std::string, MemoryEntry> byName(const std::vector<MemoryEntry>& entries) {
    std::map<std::string, MemoryEntry> named;
    for (const MemoryEntry& entry : entries) {
        EXPECT_FALSE(entry.name.empty());
        EXPECT_TRUE(named.emplace(entry.name, entry).second) << entry.name << " twice";
    }
    return named;
}

TEST(MemoryEntries, SayWhatTheBeliefsHold) {
    OwnBelief self{{1, -2, 7}, 0.04, 0.01, 900'000'000, 1, 3};
    BallBelief ball{{3, 4}, {0.5, -0.25}, 0.09, 2'000'000'000, 1'400'000'000, 0.2, 1};
    MemoryEntries entries;
    explainSelf(self, 1'000'000'000, entries);
    explainBall(ball, 2'000'000'000, entries);
    const auto said = byName(entries.all());
    EXPECT_EQ(said.at("own x").value, 1);
    EXPECT_NEAR(said.at("own heading").value, 7 - 2 * 3.14159265358979, 1e-9);
    EXPECT_NEAR(said.at("own place, std. dev.").value, 0.2, 1e-12);
    EXPECT_NEAR(said.at("own pose measured, age").value, 0.1, 1e-12);
    EXPECT_EQ(said.at("ball y").value, 4);
    EXPECT_EQ(said.at("ball vy").value, -0.25);
    EXPECT_NEAR(said.at("ball seen, age").value, 0.6, 1e-12);
    EXPECT_EQ(said.at("ball vx").unit, "m/s");
}

TEST(MemoryEntries, OfARunningRobotAreNearTheTruth) {
    ChaseBall::Options options{.target = {9, 2.5}};
    SmallWorld world(walledField(9, 5));
    world.robot(perceivingRobot({}), {2, 2, 0.5}, std::make_shared<const ChaseBall>(options), lateDrive());
    world.object(ballType(), {4, 2.5, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int tick = 0; tick < 151; ++tick) step(scenario, state, buffers);
    const auto said =
        byName(explained(scenario.controller(0), std::as_const(scenario).memoryOf(std::as_const(state), 0)));
    EXPECT_NEAR(said.at("own x").value, state.robots[0].pose.x, 0.05);
    EXPECT_NEAR(said.at("ball x").value, state.objects[0].pose.x, 0.05);
    EXPECT_NEAR(said.at("ball y").value, state.objects[0].pose.y, 0.05);
    EXPECT_FALSE(said.at("state").text.empty());
}

TEST(MemoryEntries, EveryBuiltInControllerExplainsItsEmptyMemory) {
    const ChaseBall chase{{}};
    const GoToPose go{{}};
    const Wander wander{{}};
    const CommandPlayer player({{0, {1, 0}}, {5, {0, 1}}});
    for (const Controller* controller : std::initializer_list<const Controller*>{&chase, &go, &wander, &player}) {
        alignas(8) std::byte memory[1024]{};
        ASSERT_LE(controller->memorySize(), sizeof memory);
        EXPECT_FALSE(byName(explained(*controller, {memory, controller->memorySize()})).empty());
    }
    ObservationParts observation;
    Decision decision;
    alignas(8) std::byte memory[8]{};
    player.decide(observation, memory, decision);
    EXPECT_EQ(byName(explained(player, memory)).at("commands played").value, 1);
}

}  // namespace
}  // namespace mrose
