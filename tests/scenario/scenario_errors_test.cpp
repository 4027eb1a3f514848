// Each kind of mistake in a scenario is one line that says where and what was expected.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file.h"
#include "scenario/descriptions.h"
#include "support/places.h"

namespace mrose {
namespace {

TEST(ScenarioErrors, EveryMistakeNamesItsPlace) {
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"name = \"small\"\n", "", "s.toml:1:1: name: is missing"},
        {"name = \"small\"\n", "nmae = \"small\"\n", "s.toml:3:8: nmae: is not a known key; did you mean name?"},
        {"environment = ", "enviroment = ", "s.toml:4:14: enviroment: is not a known key; did you mean environment?"},
        {"type = \"r.toml\"\nstart", "tpye = \"r.toml\"\nstart",
         "s.toml:12:8: robot[\"one\"].tpye: is not a known key; did you mean type?"},
        {"x_m = -1, y_m = 0.5", "x = -1, y_m = 0.5",
         "s.toml:13:15: robot[\"one\"].start.x: is not a known key; did you mean x_m?"},
        {"mass_kg = 2", "mas_kg = 2",
         "s.toml:31:10: object[\"crate\"].mas_kg: is not a known key; did you mean mass_kg?"},
        {"seed = 7", "seed = -7", "s.toml:5:8: seed: expected a whole number from 0 to 9223372036854775807"},
        {"seed = 7", "seed = 7.5", "s.toml:5:8: seed: expected a whole number from 0 to 9223372036854775807"},
        {"duration_s = 12.5", "duration_s = 0", "s.toml:6:14: duration_s: is 0.0; expected 0.001 to 1000000.0"},
        {"tick_s = 0.02", "tick_s = 0.2", "s.toml:7:10: tick_s: is 0.2; expected 0.001 to 0.1"},
        {"random_factor = 0.2", "random_factor = 2", "s.toml:8:17: random_factor: is 2.0; expected 0.0 to 1.0"},
        {"kick_off = false", "kick_off = \"no\"", "s.toml:9:12: kick_off: expected true or false"},
        {"kick_off = false", "kick_off = false\nvariation = 1", "s.toml:10:13: variation: expected a table"},
        {"kick_off = false", "variation = { robot_position_m = -1 }",
         "s.toml:9:34: variation.robot_position_m: is -1.0; expected 0.0 to 1000.0"},
        {"kick_off = false", "variation = { robot_heading_deg = 181 }",
         "s.toml:9:35: variation.robot_heading_deg: is 181.0; expected 0.0 to 180.0"},
        {"kick_off = false", "variation = { object_position_m = \"1\" }",
         "s.toml:9:35: variation.object_position_m: expected a finite number"},
        {"kick_off = false", "variation = { friction_share = 1 }",
         "s.toml:9:32: variation.friction_share: is 1.0; expected 0.0 to 0.99"},
        {"kick_off = false", "variation = { mass_share = 2 }",
         "s.toml:9:28: variation.mass_share: is 2.0; expected 0.0 to 0.99"},
        {"kick_off = false", "variation = { mass = 0.5 }", "s.toml:9:22: variation.mass: is not a known key"},
        {"kick_off = false", "kickoff = false", "s.toml:9:11: kickoff: is not a known key"},
        {"e.toml", "f.toml",
         "s.toml:4:15: environment: \"f.toml\" was not found; expected f.toml or mrose:resources/environments/f.toml"},
        {"\"r.toml\"", "\"e.toml\"", "e.toml:1:10: format: is \"mrose environment\"; expected one of \"mrose robot\""},
        {"type = \"r.toml\"\n", "", "s.toml:10:1: robot[\"one\"].type: is missing"},
        {"name = \"two\"", "name = \"one\"",
         "s.toml:17:8: robot[\"one\"].name: \"one\" is the name of another robot, person or object too"},
        {"name = \"ball\"", "name = \"three\"",
         "s.toml:24:8: person[\"three\"].name: \"three\" is the name of another robot, person or object too"},
        {"name = \"two\"", "name = \"\"",
         "s.toml:17:8: robot[2].name: expected a name of 1 to 64 printable characters"},
        {"y_m = 0.5, heading_deg = 90", "heading_deg = 90", "s.toml:13:9: robot[\"one\"].start.y_m: is missing"},
        {"heading_deg = 90", "bearing_deg = 1.5", "s.toml:13:46: robot[\"one\"].start.bearing_deg: is not a known key"},
        {"heading_deg = 90", "heading_deg = 900",
         "s.toml:13:46: robot[\"one\"].start.heading_deg: is 900.0; expected -360.0 to 360.0"},
        {"start = { x_m = 1, y_m = 0.5 }\n", "", "s.toml:16:1: robot[\"two\"].start: is missing"},
        {"phase_s = 0.04", "phase_s = 0.04\nnumber = 0",
         "s.toml:15:10: robot[\"one\"].number: expected a whole number from 1 to 1000000"},
        {"phase_s = 0.04", "phase_s = 0.05",
         "s.toml:14:11: robot[\"one\"].phase_s: expected a multiple of tick_s below the control period of 0.1"},
        {"phase_s = 0.04", "phase_s = 0.1",
         "s.toml:14:11: robot[\"one\"].phase_s: expected a multiple of tick_s below the control period of 0.1"},
        {"phase_s = 0.04", "phase_s = 0.04\nphase_share = 0.5",
         "s.toml:15:15: robot[\"one\"].phase_share: phase_s is there too; expected one of them"},
        {"phase_share = 0.5", "phase_share = 1.5",
         "s.toml:21:15: robot[\"two\"].phase_share: is 1.5; expected 0.0 to 1.0"},
        {"motion_robot = \"b\"", "motion_robot = \"c\"",
         "s.toml:19:16: robot[\"two\"].motion_robot: \"c\" is none of the network's robots"},
        {"name = \"one\"", "name = \"one\"\nmotion_robot = \"b\"",
         "s.toml:12:16: robot[\"one\"].motion_robot: its robot file has no network to choose a robot of"},
        {"phase_s = 0.04", "network = \"none.net\"",
         "s.toml:14:11: robot[\"one\"].network: \"none.net\" was not found; expected none.net or mrose:nets/none.net"},
        {"phase_s = 0.04", "network = \"ball.toml\"", "ball.toml:"},
        {"phase_s = 0.04", "network = 1", "s.toml:14:11: robot[\"one\"].network: "},
        {"phase_s = 0.04", "network = \"n.net\"\nmotion_robot = \"c\"",
         "s.toml:15:16: robot[\"one\"].motion_robot: \"c\" is none of the network's robots"},
        {"kind = \"ball\"\nshape", "kind = \"cube\"\nshape",
         "s.toml:36:8: object[\"ball\"].kind: is \"cube\"; expected one of \"ball\", \"box\""},
        {"inertia = 0.4", "motion = \"real\"",
         "s.toml:39:10: object[\"ball\"].motion: is \"real\"; expected one of \"floor\", \"reference\""},
        {"mass_kg = 2", "mass_kg = 2\nmotion = \"reference\"",
         "s.toml:32:10: object[\"crate\"].motion: of a box can only be \"floor\": the reference ball is no box"},
        {"inertia = 0.4", "inertia = 4", "s.toml:39:11: object[\"ball\"].inertia: is 4.0; expected 0.01 to 1.0"},
        {"kind = \"box\"", "kind = \"box\"\ninertia = 0.4",
         "s.toml:30:11: object[\"crate\"].inertia: is not a known key"},
        {"mass_kg = 0.4", "mass_kg = -1",
         "s.toml:38:11: object[\"ball\"].mass_kg: is -1.0; expected 0.001 to 100000.0"},
        {"x_mps = 1,", "x_mps = 100,",
         "s.toml:41:22: object[\"ball\"].velocity.x_mps: is 100.0; expected -20.0 to 20.0"},
        {"[[person]]", "[[people]]", "s.toml:23:1: people: is not a known key"},
        {"[[robot]]", "[[robot]", "s.toml:10:9: is not TOML: "},
    };
    for (const auto& [from, to, message] : cases)
        EXPECT_EQ(refusal("s.toml", from, to).substr(0, std::string(message).size()), message);
}

TEST(ScenarioErrors, TickMustDivideEveryControlPeriod) {
    EXPECT_EQ(refusal("s.toml", "tick_s = 0.02", "tick_s = 0.03"),
              "s.toml:12:8: robot[\"one\"].type: has a control period of 0.1; expected a multiple of tick_s = 0.03");
    EXPECT_EQ(refusal("r.toml", "control_period_s = 0.1", "control_period_s = 0.15"),
              "s.toml:12:8: robot[\"one\"].type: has a control period of 0.15; expected a multiple of tick_s = 0.02");
}

TEST(ScenarioErrors, BallMustBeACircleAboutItsReferencePoint) {
    const std::string expected =
        "s.toml:37:9: object[\"ball\"].shape: is no circle about its reference point; expected one, for a ball";
    EXPECT_EQ(refusal("ball.toml", "circle = { radius_m = 0.1 }", "polygon_m = [[0, 0], [0.1, 0], [0, 0.1]]"),
              expected);
    EXPECT_EQ(refusal("ball.toml", "radius_m = 0.1", "centre_m = [0.01, 0], radius_m = 0.1"), expected);
    EXPECT_EQ(refusal("ball.toml", "[[part]]", "[[part]]\ncircle = { radius_m = 0.05 }\n[[part]]"), expected);
}

TEST(ScenarioErrors, FilesOfAnotherKindAreSaidWithWhoNamesThem) {
    EXPECT_EQ(refusal("ball.toml", "format = \"mrose shape\"", "# Identified of a log."),
              "ball.toml:1:1: format: is missing; s.toml names this file as its shape");
    EXPECT_EQ(refusal("s.toml", "environment = \"e.toml\"", "environment = \"r.toml\""),
              "r.toml:1:10: format: is \"mrose robot\"; expected one of \"mrose environment\"; s.toml names this file "
              "as its environment");
    EXPECT_EQ(refusal("s.toml", "\"r.toml\"", "\"e.toml\""),
              "e.toml:1:10: format: is \"mrose environment\"; expected one of \"mrose robot\"; s.toml names this file "
              "as its type");
    EXPECT_EQ(refusal("r.toml", "shape = \"disc.toml\"", "shape = \"e.toml\""),
              "e.toml:1:10: format: is \"mrose environment\"; expected one of \"mrose shape\"; r.toml names this file "
              "as its shape");
}

TEST(ScenarioErrors, ControllersAreReadCompletely) {
    const auto withController = [](const std::string& text) {
        return refusal("s.toml", "{ kind = \"wander\", speed_mps = 0.2, rotation_degps = 45, change_every_s = 1 }",
                       text);
    };
    const std::pair<const char*, const char*> cases[] = {
        {"{ }", "s.toml:22:14: robot[\"two\"].controller.kind: is missing"},
        {"\"wander\"", "s.toml:22:14: robot[\"two\"].controller: expected a table"},
        {"{ kind = \"dance\" }",
         "s.toml:22:23: robot[\"two\"].controller.kind: is \"dance\"; expected one of \"velocity_script\", "
         "\"log_player\", "
         "\"go_to_pose\", \"chase_ball\", \"free_ball\", \"team_player\", \"wander\", \"dynamic_window\", "
         "\"navigate\", "
         "\"plugin\""},
        {"{ kind = \"wander\", pace = 1 }",
         "s.toml:22:40: robot[\"two\"].controller.pace: is not a known key; expected one of change_every_s, "
         "dead_time_s, kind, rotation_degps, speed_mps"},
        {"{ kind = \"wander\", speed_mps = -1 }",
         "s.toml:22:45: robot[\"two\"].controller.speed_mps: is -1.0; expected 0.0 to 20.0"},
        {"{ kind = \"go_to_pose\", targets = [] }",
         "s.toml:22:47: robot[\"two\"].controller.targets: expected 1 to 1000 poses"},
        {"{ kind = \"go_to_pose\", targets = [{ x_m = 1 }] }",
         "s.toml:22:48: robot[\"two\"].controller.targets[1].y_m: is missing"},
        {"{ kind = \"chase_ball\" }", "s.toml:22:14: robot[\"two\"].controller.target_m: is missing"},
        {"{ kind = \"navigate\" }", "s.toml:22:14: robot[\"two\"].controller.target: is missing"},
        {"{ kind = \"navigate\", target = { x_m = 1, y_m = 1 }, planner = \"astar\" }",
         "s.toml:22:76: robot[\"two\"].controller.planner: is \"astar\"; expected one of \"potential_field\", "
         "\"visibility_graph\", \"voronoi\", \"via_points\""},
        {"{ kind = \"navigate\", target = { x_m = 1, y_m = 1 }, repair = \"hope\" }",
         "s.toml:22:75: robot[\"two\"].controller.repair: is \"hope\"; expected one of \"none\", \"wait\", "
         "\"temporary_target\", \"imagined_obstacle\", \"replan\""},
        {"{ kind = \"navigate\", target = { x_m = 1, y_m = 1 }, spare_m = 0 }",
         "s.toml:22:76: robot[\"two\"].controller.spare_m: is 0.0; expected 0.01 to 5.0"},
        {"{ kind = \"navigate\", target = { x_m = 1, y_m = 1 }, methods = [\"astar+wait+lowest\"] }",
         "s.toml:22:76: robot[\"two\"].controller.methods: names \"astar+wait+lowest\"; expected PLANNER+REPAIR+FIRST, "
         "as \"visibility_graph+wait+lowest\", up to 8 of them"},
        {"{ kind = \"navigate\", target = { x_m = 1, y_m = 1 }, choose = \"none.net\" }",
         "s.toml:22:75: robot[\"two\"].controller.choose: \"none.net\" was not found; expected none.net or "
         "mrose:nets/none.net"},
        {"{ kind = \"chase_ball\", target_m = [1, 0], strokes = true }",
         "s.toml:22:66: robot[\"two\"].controller.strokes: the robot has no ball guide; expected horns that reach 3 cm "
         "farther than its front"},
        {"{ kind = \"free_ball\" }",
         "s.toml:22:23: robot[\"two\"].controller.kind: the robot has no ball guide; expected horns that reach 3 cm "
         "farther than its front"},
        {"{ kind = \"team_player\", target_m = [1, 2] }", "s.toml:22:14: robot[\"two\"].controller.choose: is missing"},
        {"{ kind = \"team_player\", target_m = [1, 2], choose = \"luck\" }",
         "s.toml:22:66: robot[\"two\"].controller.choose: is \"luck\"; expected one of \"time\", \"nearest\", "
         "\"distance_over_speed\", \"fixed\""},
        {"{ kind = \"team_player\", target_m = [1, 2], choose = \"time\" }",
         "s.toml:22:14: robot[\"two\"].controller.time: is missing"},
        {"{ kind = \"team_player\", target_m = [1, 2], choose = \"fixed\", goes = \"nine\" }",
         "s.toml:22:82: robot[\"two\"].controller.goes: \"nine\" is none of its team; expected one of it, or "
         "\"nobody\""},
        {"{ kind = \"team_player\", target_m = [1, 2], choose = \"nearest\", agree_s = 0.7 }",
         "s.toml:22:87: robot[\"two\"].controller.agree_s: is 0.7; expected 0.0 to 0.5"},
        {"{ kind = \"velocity_script\" }", "s.toml:22:14: robot[\"two\"].controller.commands: is missing"},
        {"{ kind = \"velocity_script\", commands = [{ t_s = 1 }, { t_s = 1 }] }",
         "s.toml:22:75: robot[\"two\"].controller.commands[2].t_s: is not later than that of the command before"},
        {"{ kind = \"velocity_script\", commands = [{ t_s = 1, v_mps = nan }] }",
         "s.toml:22:73: robot[\"two\"].controller.commands[1].v_mps: expected a finite number"},
        {"{ kind = \"log_player\", robot = \"1\" }", "s.toml:22:14: robot[\"two\"].controller.log: is missing"},
        {"{ kind = \"log_player\", log = \"drive\", robot = \"1\" }",
         "s.toml:22:43: robot[\"two\"].controller.log: \"drive\" was not found; expected a log of that name beside "
         "this "
         "file, "
         "in the current folder or in the folder that MROSE_DATA names, or another one by --log"},
        {"{ kind = \"plugin\" }", "s.toml:22:14: robot[\"two\"].controller.library: is missing"},
    };
    for (const auto& [controller, message] : cases) EXPECT_EQ(withController(controller), message);
    const std::string motion =
        withController("{ kind = \"team_player\", target_m = [1, 2], choose = \"time\", time = \"n.net\" }");
    EXPECT_TRUE(motion.starts_with("n.net:") && motion.find("\"motion\"; expected \"task\"") != motion.npos) << motion;
}

TEST(ScenarioErrors, TaskNetworksOfOtherNamesAreRefused) {
    auto texts =
        changedWorld("s.toml", "{ kind = \"wander\", speed_mps = 0.2, rotation_degps = 45, change_every_s = 1 }",
                     "{ kind = \"team_player\", target_m = [1, 2], choose = \"time\", time = \"t.net\" }");
    const auto other = readFile(sourceFolder() / "nets/planner_choice.net");
    ASSERT_TRUE(other) << other.error().message();
    texts["t.net"] = *other;
    const auto loaded = loadFrom(texts);
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message(), testing::StartsWith("s.toml:22:"));
    EXPECT_THAT(loaded.error().message(), testing::HasSubstr("robot[\"two\"].controller.time: t.net maps "));
    EXPECT_THAT(loaded.error().message(), testing::HasSubstr("; expected distance round bearing"));
}

TEST(ScenarioErrors, DynamicWindowNeedsASensorThatFindsObstacles) {
    const auto refused = [](const std::string& sensor, const std::string& options) {
        auto texts =
            changedWorld("s.toml", "{ kind = \"wander\", speed_mps = 0.2, rotation_degps = 45, change_every_s = 1 }",
                         "{ kind = \"dynamic_window\", waypoints_m = [[1, 2]]" + options + " }");
        texts["learned.toml"] += sensor;
        const auto loaded = loadFrom(texts);
        return loaded ? std::string() : loaded.error().message();
    };
    const std::string bumpers = "\n[[sensor]]\nkind = \"bumpers\"\nname = \"skin\"\nring = { count = 4 }\n";
    const std::string none =
        "s.toml:22:23: robot[\"two\"].controller.kind: the robot has no laser, no sonar and no infrared; expected a "
        "[[sensor]] of such a kind in its robot file";
    EXPECT_EQ(refused("", ""), none);
    EXPECT_EQ(refused(bumpers, ""), none);
    const std::string sensors[] = {
        "\n[[sensor]]\nkind = \"laser\"\nname = \"l\"\nbeams = 1\nstart_deg = 0\nend_deg = 0\n",
        "\n[[sensor]]\nkind = \"sonar\"\nname = \"s\"\ncone_deg = 30\nring = { count = 4, radius_m = 0.1 }\n",
        "\n[[sensor]]\nkind = \"infrared\"\nname = \"i\"\nring = { count = 4, radius_m = 0.1 }\nrange_m = "
        "1\nreference_m = 0.1\n"};
    for (const std::string& sensor : sensors) EXPECT_EQ(refused(bumpers + sensor, ""), "");
    const std::string& laser = sensors[0];
    const std::pair<const char*, const char*> cases[] = {
        {", pace = 1",
         "pace: is not a known key; expected one of acceleration_degps2, acceleration_mps2, clearance_weight, "
         "dead_time_s, heading_weight, kind, look_ahead_m, loop, margin_m, memory_s, progress_weight, "
         "rotation_degps, speed_mps, tolerance_m, waypoints_m"},
        {", speed_mps = 0", "speed_mps: is 0.0; expected 0.01 to 20.0"},
        {", acceleration_mps2 = 0", "acceleration_mps2: is 0.0; expected 0.01 to 100.0"},
        {", acceleration_degps2 = 0", "acceleration_degps2: is 0.0; expected 1.0 to 36000.0"},
        {", margin_m = 9", "margin_m: is 9.0; expected 0.03 to 5.0"},
        {", look_ahead_m = 0", "look_ahead_m: is 0.0; expected 0.2 to 20.0"},
        {", memory_s = 61", "memory_s: is 61.0; expected 0.0 to 60.0"},
        {", heading_weight = -1", "heading_weight: is -1.0; expected 0.0 to 100.0"},
        {", tolerance_m = 0", "tolerance_m: is 0.0; expected 0.05 to 10.0"},
    };
    for (const auto& [options, message] : cases) {
        const std::string said = refused(laser, options);
        EXPECT_NE(said.find(std::string("robot[\"two\"].controller.") + message), std::string::npos) << said;
    }
    EXPECT_NE(refused(laser, ", loop = 1").find("controller.loop: "), std::string::npos);
}

TEST(ScenarioErrors, BodiesMustNotOverlapAtTheStart) {
    // Robots of 0.2 m at (-1, 0.5) and (1, 0.5), a ball of 0.1 m, a post of 0.15 m at (3, 2), walls at +-5 and +-3.
    const auto second = [](const std::string& start) { return refusal("s.toml", "{ x_m = 1, y_m = 0.5 }", start); };
    EXPECT_EQ(second("{ x_m = -0.6, y_m = 0.5 }"), "") << "touching is no overlap";
    EXPECT_EQ(second("{ x_m = -0.60005, y_m = 0.5 }"), "") << "nor is what rounding could be";
    EXPECT_NE(second("{ x_m = -0.6002, y_m = 0.5 }"), "");
    EXPECT_EQ(second("{ x_m = -0.61, y_m = 0.5 }"),
              "s.toml:20:9: robot[\"two\"].start: \"two\" overlaps \"one\" by about 10 mm; expected room between them");
    EXPECT_EQ(
        second("{ x_m = 0.1, y_m = 0 }"),
        "s.toml:40:9: object[\"ball\"].start: \"ball\" overlaps \"two\" by about 200 mm; expected room between them");
    EXPECT_EQ(
        second("{ x_m = 4.85, y_m = 0 }"),
        "s.toml:20:9: robot[\"two\"].start: \"two\" overlaps the obstacle \"fence\" by about 50 mm; expected room "
        "between them");
    EXPECT_EQ(second("{ x_m = 4.8, y_m = 0 }"), "") << "touching is no overlap";
    EXPECT_EQ(
        second("{ x_m = 3, y_m = 2 }"),
        "s.toml:20:9: robot[\"two\"].start: \"two\" overlaps the obstacle \"post\" by about 350 mm; expected room "
        "between them");
    EXPECT_EQ(second("{ x_m = 2.75, y_m = 1.75 }"), "") << "0.3536 m from the post's centre";
    EXPECT_NE(second("{ x_m = 2.753, y_m = 1.753 }"), "") << "0.3493 m";
}

TEST(ScenarioErrors, TenThousandRobotsInOneSpotAreRefusedAtOnce) {
    auto texts = smallWorld();
    std::string& text = texts["s.toml"];
    for (int i = 0; i < 10'000; ++i)
        text += "[[robot]]\nname = \"r" + std::to_string(i) + "\"\ntype = \"r.toml\"\nstart = { x_m = 3, y_m = -2 }\n";
    EXPECT_EQ(loadFrom(texts).error().message(),
              "s.toml:49:9: robot[\"r1\"].start: \"r1\" overlaps \"r0\" by about 400 mm; expected room between them");
}

}  // namespace
}  // namespace mrose
