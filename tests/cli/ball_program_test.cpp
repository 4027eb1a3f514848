// Kickers and balls from logs, as users do it.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "scenario/environment_file.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class BallProgram : public Workshop {
protected:
    /// Synthetic kicks and throws.
    std::string kicks(int trajectories = 30) {
        const ProgramResult made = runMrose({"generate", "--set", "kicks", "--trajectories",
                                             std::to_string(trajectories), "-o", path("kicks"), "--quiet"});
        EXPECT_EQ(made.status, 0) << made.err;
        return path("kicks");
    }
};

TEST_F(BallProgram, IdentifiesABallAndWritesKeysThatFilesTake) {
    const std::string log = kicks();
    const ProgramResult result =
        runMrose({"identify-ball", log, "--environment", "synthetic_hall.toml", "-o", path("ball.toml")});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("synthetic"));
    EXPECT_THAT(result.out, HasSubstr("rolling deceleration"));
    const std::string keys = read("ball.toml");
    EXPECT_THAT(keys, HasSubstr("(synthetic: no real ball rolled)"));
    const std::size_t ofBall = keys.find("# Of a scenario");
    ASSERT_NE(ofBall, std::string::npos);
    const auto environment = parseEnvironment(
        "format = \"mrose environment\"\nversion = 1\nname = \"x\"\n" + keys.substr(0, ofBall), "x.toml");
    ASSERT_TRUE(environment) << environment.error().message();
    EXPECT_NEAR(environment->floor.rollingDeceleration, 0.42, 0.05);
    EXPECT_NEAR(environment->floor.slidingFriction, 0.37, 0.03);
    EXPECT_THAT(keys.substr(ofBall), HasSubstr("inertia = 0."));
    const ProgramResult again = runMrose({"identify-ball", log, "-o", path("ball.toml")});
    expectOneLine(again, {"ball.toml", "--overwrite"});
    const ProgramResult json = runMrose({"identify-ball", log, "--json"});
    ASSERT_EQ(json.status, 0) << json.err;
    const Json said = Json::parse(json.out);
    EXPECT_EQ(said["synthetic"], true);
    EXPECT_EQ(said["kicks"], 30);
    EXPECT_GT(said["sliding_friction"]["error"], 0);
    EXPECT_GT(said["sliding_friction"]["events"], 20);
}

TEST_F(BallProgram, WithoutABallOrAMapThereIsOneLine) {
    expectOneLine(runMrose({"identify-ball", log()}), {"holds no ball (columns ball_x and ball_y)"});
    const std::string still = write("still.csv", "t,ball_x,ball_y\n0,1,1\n0.1,1,1\n0.2,1,1\n");
    expectOneLine(runMrose({"identify-ball", still}), {"holds 3 positions of a ball, but no stretch"});
    expectOneLine(runMrose({"identify-ball", still, "--environment", "soccer.toml"}),
                  {"soccer.toml", "expected an environment"});
    expectOneLine(runMrose({"identify-ball", still, "-o", still, "--overwrite"}), {"still.csv"});
    // Too short a way for anything to be fitted to it.
    std::string brief = "t,ball_x,ball_y\n";
    for (int i = 0; i < 40; ++i)
        brief += std::to_string(0.02 * i) + ',' + std::to_string(i < 30 ? 0 : 0.02 * (i - 30)) + ",0\n";
    const std::string file = write("brief.csv", brief);
    const ProgramResult nothing = runMrose({"identify-ball", file});
    EXPECT_EQ(nothing.status, 0) << nothing.err;
    EXPECT_EQ(nothing.out.find("± 1 s.e."), std::string::npos) << "a table without rows: " << nothing.out;
    EXPECT_THAT(nothing.out, HasSubstr("not identified"));
    expectOneLine(runMrose({"identify-ball", file, "-o", path("ball.toml")}),
                  {"brief.csv", "tells nothing of its ball that", "ball.toml could hold"});
    EXPECT_EQ(read("ball.toml"), "");
}

TEST_F(BallProgram, ABallInMillimetresIsSaid) {
    std::string rows = "t,v_cmd,w_cmd,x,y,heading,kick,ball_x,ball_y\n";
    for (int i = 0; i < 1000; ++i) {
        const double rolls = std::min(std::fmod(0.02 * i, 10.0), 3.0);
        rows += std::to_string(0.02 * i) + ",0,0,0,0,0," + (i % 500 == 0 ? "1," : ",") +
                std::to_string(1500 * rolls - 250 * rolls * rolls) + ",0\n";
    }
    const std::string file = write("millimetres.csv", rows), said = "The ball would often move at more than 50 m/s";
    const ProgramResult found = runMrose({"identify-ball", file});
    EXPECT_THAT(found.out + found.err, HasSubstr(said));
    expectOneLine(runMrose({"train", file, "--kicker", "-o", path("x.net")}), {said});
}

TEST_F(BallProgram, LearnsJudgesAndSimulatesAKicker) {
    const std::string log = kicks(90);
    const std::string net = path("kicker.net");
    const ProgramResult trained =
        runMrose({"train", log, "--kicker", "--epochs", "60", "--folds", "2", "--hidden", "4", "-o", net});
    ASSERT_EQ(trained.status, 0) << trained.err;
    EXPECT_THAT(trained.out, HasSubstr("The log is synthetic"));
    EXPECT_THAT(read("kicker.net"), HasSubstr("kind = \"kick\""));
    const ProgramResult judged = runMrose({"evaluate", net, "--log", log, "--report", path("page")});
    ASSERT_EQ(judged.status, 0) << judged.err;
    for (const char* said : {"synthetic", "kicker.net", "analytic plus noise", "learned from this very log"})
        EXPECT_THAT(judged.out, HasSubstr(said));
    EXPECT_THAT(read("page/report.html"), HasSubstr("What a kick did, less what was expected of it"));
    EXPECT_THAT(read("page/kicks.csv"), HasSubstr("# synthetic"));
    expectOneLine(runMrose({"evaluate", net, "--log", log, "--report", path("page")}), {"report.html", "--overwrite"});
    const ProgramResult json = runMrose({"evaluate", net, "--log", log, "--json"});
    ASSERT_EQ(json.status, 0) << json.err;
    EXPECT_EQ(Json::parse(json.out)["models"][2]["delay_log_likelihood"], nullptr);
    write("kicking.toml",
          "format = \"mrose robot\"\nversion = 1\nname = \"kicking\"\nshape = \"pioneer1.toml\"\nmass_kg = 20\n"
          "control_period_s = 0.1\n[kinematics]\n[[manipulator]]\nname = \"kicker\"\nposition_m = [0.22, 0]\n"
          "network = \"kicker.net\"\n");
    const ProgramResult shown = runMrose({"shapes", path("kicking.toml")});
    EXPECT_EQ(shown.status, 0) << shown.err;
    write("wrong.toml", replaced(read("kicking.toml"), "network = ", "speed_mps = 3\nnetwork = "));
    expectOneLine(runMrose({"shapes", path("wrong.toml")}), {"speed_mps", "is not for a kicker with a network"});
    expectOneLine(runMrose({"evaluate", net, "--log", log, "--horizon", "5"}), {"--horizon"}, 2);
}

TEST_F(BallProgram, WhatCannotBeLearnedFromSaysWhy) {
    expectOneLine(runMrose({"train", log(), "--kicker", "-o", path("x.net")}), {"holds no kicks (column kick)"});
    const std::string blind = write("blind.csv", "t,v_cmd,w_cmd,kick\n0,0,0,\n0.1,0,0,1\n0.2,0,0,\n");
    expectOneLine(runMrose({"train", blind, "--kicker", "-o", path("x.net")}), {"holds no ball"});
    expectOneLine(runMrose({"train", kicks(20), "--kicker", "-o", path("x.net")}), {"learning needs 40"});
    expectOneLine(runMrose({"train", path("kicks"), "--kicker", "--sensor", "camera", "-o", path("x.net")}),
                  {"--kicker", "--sensor"}, 2);
    EXPECT_EQ(read("x.net"), "");
}

}  // namespace
}  // namespace mrose
