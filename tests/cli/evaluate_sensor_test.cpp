// mrose evaluate of a learned sensor.
#include <algorithm>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "perception/sensor_network.h"
#include "support/camera_folder.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using testing::HasSubstr;

class EvaluateSensorProgram : public Workshop {
protected:
    /// A sensor that was learned in no time from the log that it is judged by.
    std::string learned(const std::string& family) {
        const std::string file = path(family + ".net");
        std::vector<std::string> how{"train", folder_.path(), "--sensor", "camera", "--family", family,
                                     "-o",    file,           "--epochs", "20",     "-q",       "--overwrite"};
        if (family == "network") how.insert(how.end(), {"--hidden", "4"});
        const ProgramResult trained = runMrose(how);
        EXPECT_EQ(trained.status, 0) << trained.err;
        return file;
    }
    std::vector<std::string> words(const std::string& network, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> all{"evaluate", network, "--log", folder_.path(), "-q"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }

    const CameraFolder folder_;
};

TEST_F(EvaluateSensorProgram, ComparesNetworksWithIdealSensors) {
    const std::string table = learned("table"), trees = learned("trees");
    const ProgramResult shown = runMrose(words(table, {"--against", trees}));
    ASSERT_EQ(shown.status, 0) << shown.err;
    for (const char* text :
         {"camera of robot 1", "table.net", "trees.net", "ideal plus noise", "bearing 1 mrad",
          "Note: The network was learned from this log", "Note: trees.net was learned from this log"})
        EXPECT_THAT(shown.out, HasSubstr(text));
    const ProgramResult printed = runMrose(words(table, {"--json", "--robots", "1", "--report", path("report")}));
    ASSERT_EQ(printed.status, 0) << printed.err;
    const auto json = nlohmann::json::parse(printed.out);
    EXPECT_EQ(json["models"].size(), 3u);
    EXPECT_GT(json["models"][0]["all"]["readings"], 200);
    EXPECT_LT(json["models"][0]["all"]["range"]["crps_m"], 0.05);
    EXPECT_THAT(read("report/report.html"), HasSubstr("How true is table.net?"));
    EXPECT_EQ(read("report/results.json"), printed.out.substr(0, printed.out.size() - 1));
    expectOneLine(runMrose(words(table, {"--report", path("report")})), {"report", "--overwrite"});
}

/// A localisation that a synthetic robot reports, in two files that both say where the landmarks stand.
TEST_F(EvaluateSensorProgram, JudgesARobotsOwnLocalisation) {
    for (const char* const set : {"training", "held-out"}) {
        const ProgramResult made = runMrose({"generate", "--set", set, "--sensors", "--trajectories", "12", "--seed",
                                             set[0] == 't' ? "1" : "2", "-o", path(set), "-q"});
        ASSERT_EQ(made.status, 0) << made.err;
    }
    const ProgramResult trained = runMrose({"train", path("training"), "--sensor", "localisation", "--latency", "0.1",
                                            "-o", path("own.net"), "--epochs", "30", "--hidden", "4", "-q"});
    ASSERT_EQ(trained.status, 0) << trained.err;
    const ProgramResult shown =
        runMrose({"evaluate", path("own.net"), "--log", path("held-out"), "--report", path("localised"), "-q"});
    ASSERT_EQ(shown.status, 0) << shown.err;
    for (const char* text : {"(synthetic), localisation: ", "own.net", "ideal plus noise", "heading deg"})
        EXPECT_THAT(shown.out, HasSubstr(text));
    const auto json = nlohmann::json::parse(read("localised/results.json"));
    ASSERT_EQ(json["models"].size(), 3u);
    EXPECT_EQ(json["synthetic"], true);
    EXPECT_GT(json["models"][0]["poses"], 500);
    EXPECT_LT(json["models"][0]["ahead_m"]["crps"], json["models"][2]["ahead_m"]["crps"]) << "of an ideal one";
    EXPECT_TRUE(json["models"][2]["pose_log_likelihood"].is_null());
    EXPECT_THAT(read("localised/report.html"), HasSubstr("How true a learned localisation is"));
    EXPECT_THAT(read("localised/poses.csv"), HasSubstr("error_heading_rad,expected_heading_rad"));
    const ProgramResult predicted =
        runMrose({"predict", path("own.net"), "--log", path("held-out"), "--queries", path("localised/poses.csv"),
                  "--samples", "1", "-o", path("predicted.csv"), "-q"});
    EXPECT_EQ(predicted.status, 0) << "of all that were judged: " << predicted.err;
    const std::string camera = learned("table");
    expectOneLine(runMrose({"evaluate", path("own.net"), "--log", path("held-out"), "--against", camera}),
                  {"table.net", "expected a sensor of its robot's own pose"});
    expectOneLine(runMrose({"evaluate", path("own.net"), "--log", folder_.path()}),
                  {"has no pose that \"localisation\" reported"});
    expectOneLine(runMrose({"evaluate", path("own.net"), "--log", path("held-out"), "--report", path("localised")}),
                  {"localised", "--overwrite"});
}

TEST_F(EvaluateSensorProgram, SaysThatALogIsSynthetic) {
    ASSERT_EQ(
        runMrose({"generate", "--set", "training", "--sensors", "--trajectories", "6", "-o", path("drives"), "-q"})
            .status,
        0);
    ASSERT_EQ(runMrose({"train", path("drives"), "--sensor", "camera", "--family", "table", "-o", path("camera.net"),
                        "--epochs", "5", "-q"})
                  .status,
              0);
    const ProgramResult seen = runMrose({"evaluate", path("camera.net"), "--log", path("drives")});
    EXPECT_THAT(seen.out, HasSubstr(path("drives") + " (synthetic), camera of robot reference"));
    EXPECT_THAT(seen.out, HasSubstr("\nsynthetic "));
    const ProgramResult driven =
        runMrose({"evaluate", "pioneer.net", "--log", path("drives"), "--no-floor", "--samples", "19"});
    EXPECT_THAT(driven.out, HasSubstr(path("drives") + " (synthetic), robot reference"));
    EXPECT_THAT(driven.out, HasSubstr("\nsynthetic "));
}

TEST_F(EvaluateSensorProgram, SaysWhereCoordinatesOfReportedPosesLookExchanged) {
    ASSERT_EQ(
        runMrose({"generate", "--set", "training", "--sensors", "--trajectories", "6", "-o", path("drives"), "-q"})
            .status,
        0);
    const auto inspected = [&] {
        const ProgramResult ran = runMrose({"inspect", path("drives")});
        EXPECT_EQ(ran.status, 0) << ran.err;
        return ran.out;
    };
    const std::vector<std::string> train{
        "train", path("drives"), "--sensor", "localisation", "-o",         path("own.net"), "--epochs",
        "5",     "--hidden",     "4",        "-q",           "--overwrite"};
    const char* const said = "m with x and y exchanged: are the columns reported_x and reported_y exchanged?";
    const std::string before = inspected();
    EXPECT_THAT(before, testing::ContainsRegex("off the ground truth: 0.[0-9]+ m and [0-9.]+ deg in the median"));
    EXPECT_THAT(before, testing::Not(HasSubstr(said)));
    ASSERT_EQ(runMrose(train).status, 0);
    for (const auto& file : std::filesystem::directory_iterator(path("drives"))) {
        const std::string name = "drives/" + file.path().filename().string();
        write(name, replaced(read(name), "reported_x,reported_y", "reported_y,reported_x"));
    }
    EXPECT_THAT(inspected(), HasSubstr(said));
    expectOneLine(runMrose(train), {path("drives"), "\"localisation\" of robot reference does not fit", said});
    const ProgramResult judged = runMrose({"evaluate", path("own.net"), "--log", path("drives"), "-q"});
    EXPECT_THAT(judged.out, HasSubstr("Note: Robot reference: its poses are"));
    EXPECT_THAT(judged.out, HasSubstr(said));
}

TEST_F(EvaluateSensorProgram, ConstantNoiseIsInTheFileToTheBit) {
    const auto network = loadSensor(learned("table"));
    ASSERT_TRUE(network) << network.error().message();
    EXPECT_NEAR(network->constant.seen, 0.8, 0.1);
    EXPECT_NEAR(network->constant.spread[0], 0.03, 0.01);
    EXPECT_NEAR(network->constant.spread[1], 0.01, 0.004);
    const auto again = parseSensor(sensorText(*network), "again");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(*again == *network);
    std::string text = read("table.net");
    const auto wrong = parseSensor(replaced(text, "constant = { seen = ", "constant = { seen = 7"), "w.net");
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message(), HasSubstr("sensor.constant.seen"));
}

TEST_F(EvaluateSensorProgram, LearnsTheOtherFamiliesFromTheSameLogs) {
    const ProgramResult shown = runMrose(words(learned("trees"), {"--families"}));
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_THAT(shown.out, HasSubstr("\nnetwork "));
    EXPECT_THAT(shown.out, HasSubstr("\nlookup table "));
    EXPECT_THAT(shown.out, testing::Not(HasSubstr("\ndecision trees")));
    folder_.write(1, "Odometry", "# Time [s] v w\n1248444187.0 0.07 0.1\n");
    expectOneLine(runMrose(words(path("trees.net"), {"--families"})),
                  {"Robot1_Odometry.dat", "has other content than what", "trees.net was learned from"});
}

TEST_F(EvaluateSensorProgram, LearningASensorKnowsNoFlagsOfMotion) {
    std::vector<std::string> words{"train", folder_.path(), "--sensor",    "camera", "--family",
                                   "table", "-o",           path("x.net"), "-q"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return runMrose(more);
    };
    expectOneLine(with({"--hold-out", "0.2"}), {"--hold-out", "--sensor"}, 2);
    expectOneLine(with({"--model", "paper"}), {"--model", "--sensor"}, 2);
    expectOneLine(with({"--components", "2"}), {"--components", "network"}, 2);
    const ProgramResult printed = with({"--json"});
    ASSERT_EQ(printed.status, 0) << printed.err;
    const auto json = nlohmann::json::parse(printed.out);
    EXPECT_EQ(json["family"], "table");
    EXPECT_GT(json["readings"], 200);
}

TEST_F(EvaluateSensorProgram, ProgressIsAboutTenLinesWithoutATerminal) {
    const ProgramResult trained = runMrose(
        {"train", folder_.path(), "--sensor", "camera", "-o", path("x.net"), "--epochs", "60", "--hidden", "4"});
    ASSERT_EQ(trained.status, 0) << trained.err;
    const auto lines = std::ranges::count(trained.err, '\n');
    EXPECT_GE(lines, 4);
    EXPECT_LE(lines, 11);
    EXPECT_THAT(trained.err, HasSubstr(" left\n"));
}

TEST_F(EvaluateSensorProgram, InspectCountsFilesOfMeasurementsAndSaysWhatErrorsAre) {
    const ProgramResult shown = runMrose({"inspect", folder_.path()});
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_THAT(shown.out, HasSubstr(" of them of measurements\n"));
    EXPECT_THAT(shown.out, HasSubstr("one standard error"));
}

TEST_F(EvaluateSensorProgram, WhatDoesNotFitIsSaidInOneLine) {
    const std::string net = learned("table");
    expectOneLine(runMrose(words(net, {"--robots", "9"})), {folder_.path(), "has no robot \"9\""});
    expectOneLine(runMrose(words(net, {"--against", network()})), {network(), "motion"});
    expectOneLine(runMrose({"evaluate", network(), "--log", log(), "--against", net}), {net, "sensor"});
    expectOneLine(runMrose({"evaluate", net, "--log", log()}), {log(), "has no sensor \"camera\""});
    expectOneLine(runMrose({"evaluate", path("none.net"), "--log", log()}), {path("none.net")});
    expectOneLine(runMrose(words(net, {"--held-out"})), {"--held-out", "motion"}, 2);
    expectOneLine(runMrose({"evaluate", network(), "--log", log(), "--families"}), {"--families", "sensors"}, 2);
    write("sonar.net", replaced(read("table.net"), "name = \"camera\"", "name = \"sonar\""));
    expectOneLine(runMrose(words(net, {"--against", path("sonar.net")})),
                  {path("sonar.net"), "\"sonar\"", "\"camera\""});
    expectOneLine(runMrose(words(path("sonar.net"))), {folder_.path(), "has no sensor \"sonar\"; it has \"camera\""});
}

}  // namespace
}  // namespace mrose
