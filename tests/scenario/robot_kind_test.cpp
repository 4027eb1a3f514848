#include "scenario/robot_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shipped.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// A robot file of which nothing but its kind could be read: it has no shape and no motion.
std::string robotFile(const std::string& section) {
    return "format = \"mrose robot\"\nversion = 1\nname = \"Some robot\"\n" + section;
}

std::string errorOf(const std::string& section) {
    const auto kind = parseRobotKind(robotFile(section), "r.toml", "folder/r.toml");
    return kind ? "no error" : kind.error().message();
}

Log logOf(const std::string& format, bool synthetic = false) {
    Log log;
    log.format = format;
    log.synthetic = synthetic;
    return log;
}

TEST(RobotKind, IsReadWithoutTheRestOfItsFile) {
    const auto kind = parseRobotKind(robotFile(R"([kind]
name = "tracked-thing"
logs = ["mrclam", "synthetic"]
environment = "hall.toml"
robot_name = "thing"
robots = ["a", "b"]
[kind.learning]
wheel_phase = { half_track_m = 0.2, quantum_mps = 0.01 }
turn_offset_radps = -0.0055
turns_on_tiny_commands = true
)"),
                                     "r.toml", "r.toml");
    ASSERT_TRUE(kind) << kind.error().message();
    const RobotTraits traits{"tracked-thing", {0.2, 0.01}, -0.0055, true};
    EXPECT_TRUE((**kind == RobotKind{"r.toml", traits, {"mrclam", "synthetic"}, "hall.toml", "thing", {"a", "b"}}));
}

TEST(RobotKind, NeedsNoMoreThanAName) {
    const auto kind = parseRobotKind(robotFile("[kind]\nname = \"tug\"\n"), "r.toml", "r.toml");
    ASSERT_TRUE(kind && *kind);
    RobotKind expected;
    expected.file = "r.toml";
    expected.traits.type = "tug";
    expected.robotName = "robot";
    EXPECT_TRUE(**kind == expected);
    const auto none = parseRobotKind(robotFile(""), "r.toml", "r.toml");
    ASSERT_TRUE(none);
    EXPECT_FALSE(*none);
}

TEST(RobotKind, NamesFileLineAndKeyOfWhatDoesNotFit) {
    EXPECT_EQ(errorOf("[kind]\nlogs = [\"mrclam\"]\n"), "folder/r.toml:4:1: kind.name: is missing");
    EXPECT_EQ(errorOf("[kind]\nname = \"a\"\nlogs = [\"mrclam\", \"rosbag\"]\n"),
              "folder/r.toml:6:19: kind.logs[2]: is \"rosbag\"; expected a format of logs (mrclam, husky-windows, csv) "
              "or synthetic");
    EXPECT_THAT(errorOf("[kind]\nname = \"a\"\nlog = \"mrclam\"\n"),
                HasSubstr("kind.log: is not a known key; did you mean logs?"));
    EXPECT_THAT(errorOf("[kind]\nname = \"a\"\n[kind.learning]\nturn_offset_degps = 1\n"),
                HasSubstr("kind.learning.turn_offset_degps: is not a known key"));
    EXPECT_THAT(errorOf("[kind]\nname = \"a\"\n[kind.learning]\nwheel_phase = { half_track_m = 0.1 }\n"),
                HasSubstr("kind.learning.wheel_phase.quantum_mps: is missing"));
    const auto shape = parseRobotKind("format = \"mrose shape\"\nversion = 1\n", "s.toml", "s.toml");
    ASSERT_FALSE(shape);
    EXPECT_THAT(shape.error().message(), HasSubstr("s.toml:1:10: format: is \"mrose shape\"; expected one of"));
}

TEST(RobotKinds, OfAFolderAreToldApart) {
    const TemporaryFolder folder;
    folder.write("a.toml", robotFile("[kind]\nname = \"a\"\nlogs = [\"mrclam\"]\n"));
    folder.write("b.toml", robotFile("[kind]\nname = \"b\"\nlogs = [\"synthetic\"]\n"));
    folder.write("c.toml", robotFile(""));
    const auto kinds = readRobotKinds(folder.path());
    ASSERT_TRUE(kinds) << kinds.error().message();
    ASSERT_EQ(kinds->size(), 2u);
    EXPECT_EQ(kindOfLog(*kinds, logOf("mrclam"))->file, "a.toml");
    EXPECT_EQ(kindOfLog(*kinds, logOf("mrclam", true))->file, "a.toml")
        << "the format says more than that no real robot drove";
    EXPECT_EQ(kindOfLog(*kinds, logOf("csv", true))->file, "b.toml");
    EXPECT_EQ(kindOfLog(*kinds, logOf("csv")), nullptr);
    EXPECT_EQ(kindNamed(*kinds, "b")->file, "b.toml");
    EXPECT_EQ(kindNamed(*kinds, "c"), nullptr);

    folder.write("d.toml", robotFile("[kind]\nname = \"a\"\n"));
    EXPECT_THAT(readRobotKinds(folder.path()).error().message(),
                HasSubstr("d.toml: kind.name: \"a\" is the kind of a.toml too"));
    folder.write("d.toml", robotFile("[kind]\nname = \"d\"\nlogs = [\"csv\", \"synthetic\"]\n"));
    EXPECT_THAT(readRobotKinds(folder.path()).error().message(),
                HasSubstr("d.toml: kind.logs: \"synthetic\" are the logs of b.toml too"));
}

/// What ships fits together: a kind's network is of that kind, and tells those robots apart.
TEST(RobotKinds, ThatShipAreThoseOfTheirNetworks) {
    const RobotKinds kinds = shippedKinds();
    ASSERT_EQ(kinds.size(), 3u);
    for (const RobotKind& kind : kinds) {
        const RobotDescription robot = shippedRobot(kind.file.substr(0, kind.file.size() - 5));
        ASSERT_TRUE(robot.kind && robot.motion) << kind.file;
        EXPECT_TRUE(*robot.kind == kind) << kind.file;
        const MotionNetwork& network = robot.motion->network();
        EXPECT_EQ(network.robotType, kind.traits.type);
        EXPECT_EQ(network.robots, kind.robots) << kind.file;
        EXPECT_TRUE(network.wheelPhase == kind.traits.wheelPhase) << kind.file;
        EXPECT_EQ(network.turnOffset, kind.traits.turnOffset) << kind.file;
    }
    EXPECT_EQ(kindOfLog(kinds, logOf("mrclam"))->environment, "mrclam_arena.toml");
    EXPECT_EQ(kindOfLog(kinds, logOf("husky-windows"))->robotName, "husky");
    EXPECT_EQ(kindOfLog(kinds, logOf("csv", true))->file, "pioneer1.toml");
    EXPECT_EQ(kindOfLog(kinds, logOf("csv")), nullptr);
}

}  // namespace
}  // namespace mrose
