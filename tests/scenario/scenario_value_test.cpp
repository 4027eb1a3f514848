// Scenarios as values: what is changed by a path, and what is made of that.
#include "scenario/scenario_value.h"

#include <gtest/gtest.h>

#include "motion/learned_model.h"
#include "motion/network_fixture.h"
#include "motion/same_motion.h"
#include "scenario/descriptions.h"
#include "scenario/variation.h"
#include "support/places.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

const LearnedModel* learnedModel(const LoadedScenario& loaded, std::size_t robot) {
    return learnedModel(loaded.parts.scene.modelOf(robot));
}

/// The value with a network as one robot's motion.
Expected<LoadedScenario> movedBy(const LoadedScenario& loaded, const std::string& robot, const MotionNetwork& network) {
    const auto value = loaded.value.with(
        loaded.value.bodyPath(robot) + ".network",
        std::make_shared<const DescriptionFile>(DescriptionFile{"/x/new.net", "/x/new.net", networkText(network)}));
    return value ? loadScenario(*value) : tl::unexpected(value.error());
}

/// A network that a robot of kinematics gets, and one that replaces a learned robot's.
TEST(ScenarioValue, NetworkOfOneRobotIsSwapped) {
    const auto original = loadFrom(smallWorld());
    const MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::history);
    for (const auto& [robot, index] : {std::pair("one", 0u), {"two", 1u}, {"three", 2u}}) {
        const auto loaded = movedBy(*original, robot, network);
        ASSERT_TRUE(loaded) << loaded.error().message();
        for (std::size_t i = 0; i < 3; ++i) {
            if (i == index) {
                ASSERT_NE(learnedModel(*loaded, i), nullptr);
                EXPECT_EQ(learnedModel(*loaded, i)->network(), network);
            } else {
                EXPECT_TRUE(sameMotion(loaded->parts.scene.modelOf(i), original->parts.scene.modelOf(i)));
            }
        }
        EXPECT_EQ(loaded->parts.scene.robots[index].type, original->parts.scene.robots[index].type);
        EXPECT_EQ(loaded->value.without(loaded->value.bodyPath(robot) + ".network"), original->value);
    }
}

TEST(ScenarioValue, NetworkChoosesItsRobotAsTheFileSaysWhereItHasSuch) {
    auto texts = changedWorld("s.toml", "motion_robot = \"b\"\n", "");
    MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::state);
    EXPECT_EQ(learnedModel(*loadFrom(texts), 1)->robot(), -1);
    texts["learned.toml"] += "robot = \"b\"\n";
    const auto chosen = loadFrom(texts);
    EXPECT_EQ(learnedModel(*chosen, 1)->robot(), 1);
    EXPECT_EQ(learnedModel(*movedBy(*chosen, "two", network), 1)->robot(), 1);
    for (std::string& robot : network.robots) robot += "'";
    for (auto& identified : network.identified) identified.robot += "'";
    for (NetworkInput& input : network.inputs)
        if (!input.robot.empty()) input.robot += "'";
    const auto other = movedBy(*chosen, "two", network);
    ASSERT_TRUE(other) << other.error().message();
    EXPECT_EQ(learnedModel(*other, 1)->robot(), -1);
}

TEST(ScenarioValue, WhatDoesNotFitIsToldByItsPath) {
    const auto loaded = loadFrom(smallWorld());
    const auto refused = [&](const char* assignment) {
        const auto value = loaded->value.overridden(assignment);
        if (!value) return value.error().message();
        const auto again = loadScenario(*value);
        return again ? std::string() : again.error().message();
    };
    MotionNetwork slow = arbitraryNetwork(MotionNetwork::Form::state);
    slow.period = 60'000'000;
    EXPECT_NE(movedBy(*loaded, "one", slow)
                  .error()
                  .message()
                  .find("robot[\"one\"].network: was learned for a control period of 0.06 s; the robot's is 0.1 s"),
              std::string::npos);
    EXPECT_EQ(refused("seed"), "seed: expected PATH=VALUE, such as robot[2].network=create.net or seed=4");
    EXPECT_NE(refused("seed=-1").find("seed: expected a whole number from 0 to "), std::string::npos);
    EXPECT_NE(refused("robot[1].type.mass_kg=0").find("mass_kg: is 0.0; expected 0.001 to"), std::string::npos);
    EXPECT_NE(refused("robot[1].colour=red").find("colour: is not a known key"), std::string::npos);
    EXPECT_EQ(refused("robot[9].network=n.net"),
              "s.toml: robot[9].network: names nothing that there is; expected a path such as robot[2].network");
    EXPECT_NE(refused("robot[1].network=none.net").find("\"none.net\" was not found"), std::string::npos);
    // No line of a file says this.
    EXPECT_EQ(refused("robot[1].start={x_m=0,y_q=2}"),
              "s.toml: robot[\"one\"].start.y_q: is not a known key; did you mean y_m?");
}

TEST(ScenarioValue, OverridesAreOfTheirTypes) {
    const auto loaded = loadFrom(smallWorld());
    ScenarioValue value = loaded->value;
    for (const char* const assignment :
         {"seed=41", "robot[\"one\"].type.mass_kg = 3", "robot[2].start={x_m=1.5,y_m=0.25}", "name=other",
          "environment.floor.sliding_friction=0.125"}) {
        auto changed = value.overridden(assignment);
        ASSERT_TRUE(changed) << changed.error().message();
        value = std::move(*changed);
    }
    const auto again = loadScenario(value);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->parts.seed, 41u);
    EXPECT_EQ(again->parts.name, "other");
    EXPECT_EQ(again->parts.scene.typeOf(0).mass, 3);
    EXPECT_EQ(again->parts.scene.typeOf(2).mass, loaded->parts.scene.typeOf(2).mass) << "another robot of that file";
    EXPECT_EQ(again->parts.scene.robots[1].start, (Pose{1.5, 0.25, 0}));
    EXPECT_EQ(again->parts.scene.environment.floor.slidingFriction, 0.125);
    EXPECT_NE(value.hash(), loaded->value.hash());
}

/// A description in other files, order and words of comments is the same scenario.
TEST(ScenarioValue, HashIsOfWhatItSays) {
    auto texts = smallWorld();
    const auto loaded = loadFrom(texts);
    texts["s.toml"] = "# a comment\n" + texts["s.toml"];
    texts["round.toml"] = texts["disc.toml"];
    texts["r.toml"].replace(texts["r.toml"].find("disc.toml"), 9, "round.toml");
    const auto moved = loadFrom(texts);
    ASSERT_TRUE(moved) << moved.error().message();
    EXPECT_EQ(moved->value.hash(), loaded->value.hash());
    EXPECT_EQ(moved->value, loaded->value);
    texts["round.toml"].replace(texts["round.toml"].find("0.2"), 3, "0.3");
    EXPECT_NE(loadFrom(texts)->value.hash(), loaded->value.hash());
}

/// What is drawn for a trial stands in its value, to the bit.
TEST(ScenarioValue, TrialsAreValues) {
    DiskDescriptions disk({sourceFolder(), {}, ""});
    const auto soccer = loadScenario("soccer.toml", disk);
    ASSERT_TRUE(soccer) << soccer.error().message();
    for (const std::uint32_t trial : {1u, 2u, 17u}) {
        const auto parts = varied(soccer->parts, trial);
        const auto whole = varied(*soccer, trial);
        ASSERT_TRUE(parts && whole);
        EXPECT_NE(whole->value.hash(), soccer->value.hash());
        const auto again = loadScenario(ScenarioValue::parse(whole->value.bytes()).value());
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_EQ(again->parts.scene.environment.floor.slidingFriction, parts->scene.environment.floor.slidingFriction);
        EXPECT_EQ(hashOf(stateAfter(*parts, 200)), hashOf(stateAfter(again->parts, 200)));
    }
    EXPECT_EQ(varied(*soccer, 0)->value, soccer->value);
}

}  // namespace
}  // namespace mrose
