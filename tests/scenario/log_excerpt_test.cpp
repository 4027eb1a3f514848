#include "scenario/log_excerpt.h"

#include <gtest/gtest.h>

#include "logs/csv_reader.h"
#include "motion/network_fixture.h"
#include "scenario/descriptions.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"

namespace mrose {
namespace {

/// Two robots: "a" is commanded from 100.0 s on and tracked from 100.5 s on, "b" from 101 and 100 s on.
constexpr const char* twoRobots = R"(t,robot,v_cmd,w_cmd,x,y,heading
100.0,a,0.1,0,,,
100.2,a,0.1,0,,,
100.5,a,,,1,2,0.5
100.9,a,0.2,-0.5,,,
101.5,a,,,1,2,0.5
102.5,a,0.3,0,3,4,1.5
104.0,a,0.3,0,3,4,1.5
104.5,a,0,0.1,3,4,1.5
100.0,b,,,7,8,0
101.0,b,0.4,0,7,8,0
103.0,b,0.4,0.2,7,8,0
105.0,b,0.4,0,7,8,0
)";

Log log() { return parseCsv(twoRobots, "log").value(); }

ExcerptContent excerpt(const LogExcerpt& which) {
    const auto content = excerptOf(log(), which);
    EXPECT_TRUE(content) << content.error().message();
    return content.value_or(ExcerptContent{});
}

std::vector<StampedCommand> commands(std::initializer_list<std::tuple<double, double, double>> rows) {
    std::vector<StampedCommand> all;
    for (const auto& [t, v, w] : rows) all.push_back({fromSeconds(t), {v, w}});
    return all;
}

TEST(LogExcerpt, RobotsOfOneLogStartTogetherWhenAllAreThere) {
    // b is commanded from 101 s on, the last of all beginnings.
    const ExcerptContent a = excerpt({"log", "log", "a", "", 0});
    EXPECT_EQ(a.commands, commands({{-1, 0.1, 0}, {-0.1, 0.2, -0.5}, {1.5, 0.3, 0}, {3.5, 0, 0.1}, {4, 0, 0}}))
        << "repetitions are left out, and half a second after its last command it stands";
    ASSERT_TRUE(a.start);
    EXPECT_EQ(*a.start, (Pose{1, 2, 0.5}));
    const ExcerptContent b = excerpt({"log", "log", "b", "", 0});
    EXPECT_EQ(b.commands, commands({{0, 0.4, 0}, {2, 0.4, 0.2}, {4, 0.4, 0}, {4.5, 0, 0}}));
    EXPECT_EQ(*b.start, (Pose{7, 8, 0}));
}

TEST(LogExcerpt, StartIsCountedFromThere) {
    const ExcerptContent a = excerpt({"log", "log", "a", "", 1.5});
    EXPECT_EQ(a.commands.back(), (StampedCommand{fromSeconds(2.5), {}}));
    EXPECT_EQ(*a.start, (Pose{3, 4, 1.5}));
    EXPECT_EQ(excerptOf(log(), {"log", "log", "a", "", 3.5}).error().message(),
              "log: robot \"a\" has no commands after 3.5 s from the log's start");
}

TEST(LogExcerpt, OnlyTheCommandInForceThreeSecondsBeforeIsKept) {
    std::string rows = "t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 100; ++i) rows += std::to_string(10 + 0.1 * i) + ',' + std::to_string(0.001 * i) + ",0,1,1,0\n";
    const Log steady = parseCsv(rows, "log").value();
    const auto content = excerptOf(steady, {"log", "log", steady.robots[0].robot, "", 5});
    ASSERT_TRUE(content) << content.error().message();
    EXPECT_EQ(content->commands.front().time, -3 * nanosecondsPerSecond);
    EXPECT_EQ(content->commands.front().command.v, 0.02);
}

TEST(LogExcerpt, WithoutGroundTruthThereIsNoStartPose) {
    const Log blind = parseCsv("t,v_cmd,w_cmd\n5,0.1,0\n6,0.2,0\n7,0.3,0\n", "log").value();
    const auto content = excerptOf(blind, {"log", "log", blind.robots[0].robot, "", 1.5});
    ASSERT_TRUE(content) << content.error().message();
    EXPECT_FALSE(content->start);
    EXPECT_EQ(content->commands, commands({{0, 0.2, 0}, {0.5, 0.3, 0}, {1, 0, 0}}));
}

TEST(LogExcerpt, ComesBackFromItsValueToTheBit) {
    const ExcerptContent content = excerpt({"log", "log", "a", "", 1.5});
    const auto again = parseExcerpt(excerptValue(content));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->commands, content.commands);
    EXPECT_EQ(again->start, content.start);
    for (const Value& unsound : {Value(), Value(Value::Table{}), Value(Value::Table{{"commands", "x"}}),
                                 Value(Value::Table{{"commands", ""}, {"start", Value::Array{1.0, 2.0}}})})
        EXPECT_FALSE(parseExcerpt(unsound));
}

TEST(LogExcerpt, UnknownRobotsAndTrajectoriesAreNamed) {
    EXPECT_EQ(excerptOf(log(), {"log", "log", "c", "", 0}).error().message(), "log: has no robot \"c\"");
    EXPECT_EQ(excerptOf(log(), {"log", "log", "a", "run9", 0}).error().message(),
              "log: has no trajectory \"run9\" of robot \"a\"");
}

TEST(LogExcerpt, ScenarioKeepsItAndLoadsItWithoutTheLog) {
    const TemporaryFolder folder;
    for (const auto& [name, text] : smallWorld()) folder.write(name, text);
    folder.write("drives/two.csv", twoRobots);
    std::string scenario = smallWorld().at("s.toml");
    const std::string wander = "{ kind = \"wander\", speed_mps = 0.2, rotation_degps = 45, change_every_s = 1 }";
    scenario.replace(scenario.find(wander), wander.size(),
                     "{ kind = \"log_player\", log = \"drives/two.csv\", robot = \"a\", start_s = 1.5 }");
    const std::string start = "start = { x_m = 1, y_m = 0.5 }\n";
    scenario.erase(scenario.find(start), start.size());
    folder.write("s.toml", scenario);
    const std::string name = (folder.path() / "s.toml").string();
    DiskDescriptions disk({sourceFolder(), {}, ""});
    const auto loaded = loadScenario(name, disk);
    // The log's robot stands at (3, 4), beyond the yard's fence, where nothing is in its way.
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->parts.scene.robots[1].start, (Pose{3, 4, 1.5}));
    const auto again = loadScenario(loaded->value);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->value, loaded->value);
    EXPECT_EQ(again->parts.scene.robots[1].start, loaded->parts.scene.robots[1].start);
    for (const auto* const parts : {&loaded->parts, &again->parts}) {
        const std::vector<StampedCommand>& sent = parts->scene.robots[1].sent;
        ASSERT_FALSE(sent.empty());
        EXPECT_LT(sent.front().time, -nanosecondsPerSecond) << "also those before the start";
        EXPECT_LE(sent.back().time, 0);
    }

    DiskDescriptions other({sourceFolder(), {}, (folder.path() / "none.csv").string()});
    EXPECT_EQ(loadScenario(name, other).error().message(), (folder.path() / "none.csv").string() + ": does not exist")
        << "the log that the user names instead";
}

TEST(LogExcerpt, PlayersReadWhatTheyAreAskedToAndTheRobotHas) {
    auto files = smallWorld();
    files["drives/two.csv"] = twoRobots;
    const std::string wander = "{ kind = \"wander\", speed_mps = 0.2, rotation_degps = 45, change_every_s = 1 }";
    const auto attention = [&](const std::string& reads) -> Expected<Attention> {
        const TemporaryFolder folder;
        std::string scenario = files.at("s.toml");
        scenario.replace(scenario.find(wander), wander.size(),
                         "{ kind = \"log_player\", log = \"drives/two.csv\", robot = \"a\"" + reads + " }");
        for (const auto& [name, text] : files) folder.write(name, name == "s.toml" ? scenario : text);
        DiskDescriptions disk({sourceFolder(), {}, ""});
        const auto loaded = loadScenario((folder.path() / "s.toml").string(), disk);
        if (!loaded) return tl::unexpected(loaded.error());
        return loaded->parts.controllers[1]->attention();
    };
    ASSERT_TRUE(attention(""));
    EXPECT_EQ(*attention(""), Attention::ofItself());
    const auto some = attention(", reads = [\"robots\", \"camera\"]");
    ASSERT_TRUE(some) << some.error().message();
    EXPECT_TRUE(some->reads(robotsReading) && some->reads(selfReading));
    EXPECT_FALSE(some->reads(objectsReading) || some->reads("camera.robots")) << "it has no camera";
    for (auto& [name, text] : files)
        if (text.find("\"mrose robot\"") != std::string::npos)
            text += "\n[[sensor]]\nkind = \"camera\"\nname = \"camera\"\n";
    const auto more = attention(", reads = [\"robots\", \"camera\"]");
    ASSERT_TRUE(more) << more.error().message();
    EXPECT_TRUE(more->reads("camera.robots") && more->reads("camera.objects"));
    EXPECT_NE(attention(", reads = [\"" + std::string(40, 'x') + "\"]").error().message().find("controller.reads"),
              std::string::npos);
}

/// As mrose predict and compare read them.
TEST(LogExcerpt, WheelCommandsAreReadByTheGeometryThatTheNetworkLearned) {
    const TemporaryFolder folder;
    for (const auto& [name, text] : smallWorld()) folder.write(name, text);
    MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::state);
    network.drive = DifferentialDrive{0.2, 0.5};
    folder.write("n.net", networkText(network));
    std::string log =
        "window,calib_step,t_s,cmd_left_radps,cmd_right_radps,wheel_left_radps,wheel_right_radps,icp_x_m,icp_y_m,"
        "icp_yaw_rad,imu_yaw_rad,steady\n";
    for (int i = 0; i < 40; ++i) log += "0,0," + std::to_string(0.05 * i) + ",2,3,1,1,1,0.5,0,0,1\n";
    folder.write("wheels.csv", log);
    std::string scenario = smallWorld().at("s.toml");
    const std::string wander = "{ kind = \"wander\", speed_mps = 0.2, rotation_degps = 45, change_every_s = 1 }";
    scenario.replace(scenario.find(wander), wander.size(),
                     "{ kind = \"log_player\", log = \"wheels.csv\", robot = \"husky\" }");
    folder.write("s.toml", scenario);
    DiskDescriptions disk({sourceFolder(), {}, ""});
    const auto loaded = loadScenario((folder.path() / "s.toml").string(), disk);
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Value* const played = loaded->value.at(loaded->value.bodyPath("two") + ".controller.log");
    ASSERT_TRUE(played && played->asFile());
    EXPECT_EQ(played->asFile()->reference, "wheels.csv");
    const auto content = parseExcerpt(played->asFile()->content);
    ASSERT_TRUE(content && !content->commands.empty());
    EXPECT_NEAR(content->commands.front().command.v, 0.2 * (2 + 3) / 2, 1e-12);
    EXPECT_NEAR(content->commands.front().command.w, 0.2 * (3 - 2) / 0.5, 1e-12);
    EXPECT_TRUE(loadScenario(loaded->value));
}

TEST(LogExcerpt, RealLogDrivesTheReplayThatShips) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs";
    DiskDescriptions disk({sourceFolder(), {*data / "mrclam"}, ""});
    const auto replay = loadScenario("mrclam_replay.toml", disk);
    ASSERT_TRUE(replay) << replay.error().message();
    const Scene& scene = replay->parts.scene;
    ASSERT_EQ(scene.robots.size(), 5u);
    EXPECT_EQ(scene.models.size(), 5u) << "each moves like itself";
    EXPECT_EQ(scene.robotTypes.size(), 1u);
    for (const SceneRobot& robot : scene.robots)
        EXPECT_TRUE(contains(scene.environment.floor.area, position(robot.start)));
    const auto again = ScenarioValue::parse(replay->value.bytes());
    ASSERT_TRUE(again);
    EXPECT_EQ(*again, replay->value);
    EXPECT_TRUE(loadScenario(*again));
}

}  // namespace
}  // namespace mrose
