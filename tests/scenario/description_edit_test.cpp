#include "scenario/description_edit.h"

#include <gtest/gtest.h>

#include "io/toml_edit.h"
#include "motion/learned_model.h"
#include "motion/network_fixture.h"
#include "motion/same_motion.h"
#include "scenario/descriptions.h"

namespace mrose {
namespace {

std::string edited(const std::string& text, const TomlPlace& place, const std::string& value) {
    const auto result = withTomlValue(text, "f", place, value);
    return result ? *result : result.error().message();
}

TEST(TomlEdit, LeavesAllElse) {
    const std::string text =
        "# head\nversion = 1 # one\n\n[[a]] # first\nname = \"x\" # x\nb = 2\n[a.c]\nd = 1\n[[a]]\n";
    EXPECT_EQ(edited(text, {"a[0]", "n", "name"}, "\"v\""),
              "# head\nversion = 1 # one\n\n[[a]] # first\nname = \"x\" # x\nn = \"v\"\nb = 2\n[a.c]\nd = 1\n[[a]]\n");
    EXPECT_EQ(edited(text, {"a[0]", "n"}, "3"),
              "# head\nversion = 1 # one\n\n[[a]] # first\nn = 3\nname = \"x\" # x\nb = 2\n[a.c]\nd = 1\n[[a]]\n");
    EXPECT_EQ(edited(text, {"a[0]", "name"}, "\"longer\""),
              "# head\nversion = 1 # one\n\n[[a]] # first\nname = \"longer\" # x\nb = 2\n[a.c]\nd = 1\n[[a]]\n");
    EXPECT_EQ(edited(text, {"a[0].c", "e"}, "true"),
              "# head\nversion = 1 # one\n\n[[a]] # first\nname = \"x\" # x\nb = 2\n[a.c]\ne = true\nd = 1\n[[a]]\n");
    EXPECT_EQ(edited(text, {"a[1]", "e"}, "true"), text + "e = true\n");
    EXPECT_EQ(edited(text, {"", "seed", "version"}, "7"),
              "# head\nversion = 1 # one\nseed = 7\n\n[[a]] # first\nname = \"x\" # x\nb = 2\n[a.c]\nd = 1\n[[a]]\n");
    EXPECT_EQ(edited(text, {"", "seed"}, "7"), "seed = 7\n" + text);
}

TEST(TomlEdit, LeavesATableOutWithAllThatBelongsToIt) {
    const std::string text =
        "version = 1\n[[a]] # first\nname = \"x\"\n[a.c]\nd = 1\n[[a.e]]\nf = 1\n[[a]]\nname = \"y\"\n[g]\nh = 1\n";
    const auto without = [&](const std::string& path) {
        const auto result = withoutTomlTable(text, "f", path);
        return result ? *result : result.error().message();
    };
    EXPECT_EQ(without("a[0]"), "version = 1\n[[a]]\nname = \"y\"\n[g]\nh = 1\n");
    EXPECT_EQ(without("a[1]"), "version = 1\n[[a]] # first\nname = \"x\"\n[a.c]\nd = 1\n[[a.e]]\nf = 1\n[g]\nh = 1\n");
    EXPECT_EQ(without("a[2]"), "f: has no a[2]");
    const auto inlineTable = withoutTomlTable("a = [{ b = 1 }, { b = 2 }]", "f", "a[0]");
    ASSERT_FALSE(inlineTable);
    EXPECT_NE(inlineTable.error().message().find("expected a table under [[a]]"), std::string::npos);
}

TEST(TomlEdit, InlineTablesOddLettersAndLineEnds) {
    EXPECT_EQ(edited("a = [{ name = \"süß\", b = 1 }, {name='y'}]\r\n", {"a[0]", "n"}, "2"),
              "a = [{ n = 2, name = \"süß\", b = 1 }, {name='y'}]\r\n");
    EXPECT_EQ(edited("a = [{ name = \"süß\", b = 1 }]", {"a[0]", "b"}, "22"), "a = [{ name = \"süß\", b = 22 }]");
    EXPECT_EQ(edited("[[a]]\r\nb = 1\r\n", {"a[0]", "n", "b"}, "2"), "[[a]]\r\nb = 1\r\nn = 2\r\n");
    EXPECT_EQ(edited("[[a]]\nb = 1", {"a[0]", "n", "b"}, "2"), "[[a]]\nb = 1\nn = 2\n");
    EXPECT_EQ(edited("b = \"\"\"\nx\ny\"\"\" # c\nd = 1\n", {"", "n", "b"}, "2"),
              "b = \"\"\"\nx\ny\"\"\" # c\nn = 2\nd = 1\n");
    EXPECT_EQ(edited("b = \"\"\"\nx\ny\"\"\" # c\n", {"", "b"}, "2"), "b = 2 # c\n");
    EXPECT_EQ(tomlString("a\"b\\c\n\x7f"), "\"a\\\"b\\\\c\\u000A\\u007F\"");
}

TEST(TomlEdit, WhatIsNotThereIsSaid) {
    EXPECT_EQ(edited("a = 1\n", {"b[0]", "c"}, "1"), "f: has no b[0]");
    EXPECT_EQ(edited("a = 1\n", {"a", "c"}, "1"), "f: has no a");
    EXPECT_TRUE(edited("a = \n", {"", "c"}, "1").starts_with("f:1:"));
    EXPECT_EQ(edited("a = 1\n", {"", "c"}, "1 2"), "f: c cannot be written into its text");
}

const LearnedModel* learnedModel(const LoadedScenario& loaded, std::size_t robot) {
    return dynamic_cast<const LearnedModel*>(&loaded.parts.scene.modelOf(robot));
}

/// A network that a robot of kinematics gets, and one that replaces a learned robot's.
TEST(WithNetwork, SwapsTheModelOfOneRobot) {
    const Descriptions before{"s.toml", smallWorld()};
    const auto original = loadFrom(before.texts);
    const MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::history);
    for (const auto& [robot, index] : {std::pair("one", 0u), {"two", 1u}, {"three", 2u}}) {
        const auto swapped = withNetwork(before, robot, "nets/new.net", networkText(network));
        ASSERT_TRUE(swapped) << swapped.error().message();
        const auto loaded = loadFrom(swapped->texts);
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
        // Taken out again, the text is what it was; another one takes its place.
        std::string text = swapped->texts.at("s.toml");
        const std::string line = "network = \"nets/new.net\"\n";
        ASSERT_NE(text.find(line), std::string::npos);
        EXPECT_EQ(text.erase(text.find(line), line.size()), before.texts.at("s.toml"));
        const auto again = withNetwork(*swapped, robot, "n.net", before.texts.at("n.net"));
        ASSERT_TRUE(again);
        EXPECT_EQ(again->texts.at("s.toml").find("nets/new.net"), std::string::npos);
        EXPECT_EQ(learnedModel(*loadFrom(again->texts), index)->network(),
                  arbitraryNetwork(MotionNetwork::Form::state));
    }
}

TEST(WithNetwork, ChoosesItsRobotAsTheFileSaysWhereItHasSuch) {
    const Descriptions before{"s.toml", changedWorld("s.toml", "motion_robot = \"b\"\n", "")};
    MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::state);
    const auto robotOf = [&](const Descriptions& of) { return learnedModel(*loadFrom(of.texts), 1)->robot(); };
    EXPECT_EQ(robotOf(before), -1);
    Descriptions chosen = before;
    std::string& text = chosen.texts["learned.toml"];
    text += "robot = \"b\"\n";
    EXPECT_EQ(robotOf(chosen), 1);
    EXPECT_EQ(robotOf(*withNetwork(chosen, "two", "x.net", networkText(network))), 1);
    for (std::string& robot : network.robots) robot += "'";
    for (auto& identified : network.identified) identified.robot += "'";
    for (NetworkInput& input : network.inputs)
        if (!input.robot.empty()) input.robot += "'";
    const auto other = withNetwork(chosen, "two", "x.net", networkText(network));
    ASSERT_TRUE(loadFrom(other->texts)) << loadFrom(other->texts).error().message();
    EXPECT_EQ(robotOf(*other), -1);
}

TEST(WithNetwork, AnotherPeriodIsRefusedWithItsLine) {
    MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::state);
    network.period = 60'000'000;
    const auto swapped = withNetwork({"s.toml", smallWorld()}, "one", "/x/slow.net", networkText(network));
    ASSERT_TRUE(swapped);
    EXPECT_TRUE(swapped->texts.contains("/x/slow.net"));
    EXPECT_EQ(loadFrom(swapped->texts).error().message(),
              "s.toml:13:11: robot[\"one\"].network: was learned for a control period of 0.06 s; the robot's is 0.1 s");
}

TEST(WithNetwork, WhoIsNotThereIsSaid) {
    const Descriptions world{"s.toml", smallWorld()};
    EXPECT_EQ(withNetwork(world, "four", "n.net", "").error().message(), "s.toml: has no robot \"four\"");
    EXPECT_TRUE(withNetwork({"s.toml", {{"s.toml", "x = \n"}}}, "one", "n.net", "")
                    .error()
                    .message()
                    .starts_with("s.toml:1:5: is not TOML: "));
}

TEST(WithSeed, SetsTheSeed) {
    const Descriptions world{"s.toml", smallWorld()};
    const auto changed = withSeed(world, 12345);
    ASSERT_TRUE(changed);
    EXPECT_EQ(loadFrom(changed->texts)->parts.seed, 12345u);
    Descriptions without{"s.toml", changedWorld("s.toml", "seed = 7\n", "")};
    EXPECT_EQ(loadFrom(withSeed(without, 99)->texts)->parts.seed, 99u);
    EXPECT_FALSE(withSeed(world, std::uint64_t{1} << 63));
}

}  // namespace
}  // namespace mrose
