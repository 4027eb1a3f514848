// `mrose tune` as its users run it, and what reads its settings.
#include <algorithm>
#include <csignal>
#include <filesystem>

#include <gmock/gmock.h>

#include "support/game_folder.h"
#include "support/places.h"
#include "tuning/lane.h"
#include "workflow/read_trials.h"

namespace mrose {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class TuneProgram : public GameFolder {
protected:
    TuneProgram() {
        Lane lane;
        for (const auto& [name, text] : lane.texts) write(name, text);
        write("t.toml", std::string(Lane::head) + Lane::budget + Lane::speed);
    }
    ProgramResult tune(const std::string& folder, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"tune", path("t.toml"), "-o", path(folder), "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return runMrose(words);
    }
};

TEST_F(TuneProgram, WritesSettingsCandidatesAndAPage) {
    const ProgramResult result = tune("out");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("off, in 20 trials held out, with 95 % intervals: before "));
    EXPECT_THAT(result.out, HasSubstr(path("out") + "/settings.toml, report.html written"));
    for (const char* name : {"settings.toml", "candidates.csv", "report.html", "results.csv", "batch.txt"})
        EXPECT_NE(read(std::string("out/") + name), "") << name;
    EXPECT_THAT(read("out/settings.toml"), HasSubstr("\"robot[1].controller.commands[1].v_mps\" = 0.2"));
    const auto candidates = csvRows(read("out/candidates.csv"));
    ASSERT_GT(candidates.size(), 5u);
    EXPECT_EQ(candidates[0].at("speed"), "0.4");
    const Json again = told(tune("out", {"--json"}));
    EXPECT_EQ(again["complete"], true);
    EXPECT_EQ(again["resumed"], again["runs"]);
    EXPECT_EQ(again["candidates"], candidates.size());
    EXPECT_EQ(again["parameters"][0]["before"], 0.4);
    EXPECT_LT(again["held_out"]["change"]["high"], 0);
}

TEST_F(TuneProgram, SaysWhereWhatIsTunedDrivesAsItsNetworkHasNotLearned) {
    const ProgramResult known = tune("kinematic");
    EXPECT_EQ(known.status, 0) << known.err;
    EXPECT_THAT(known.out, testing::Not(HasSubstr("Note: ")));
    EXPECT_FALSE(told(tune("kinematic", {"--json"})).contains("unfamiliar")) << "no network knows";
    // Which drove up to 0.086 m/s: a metre in 4 s is beyond, and what it begins with is not.
    write("r.toml", replaced(read("r.toml"), "[kinematics]\n[motion_noise]\ndistance_per_distance = 0.05\n",
                             "[motion]\nnetwork = \"create.net\"\n"));
    write("t.toml", std::string(Lane::head) + Lane::budget + Lane::speed + "start = 0.06\n");
    const ProgramResult beyond = tune("learned");
    EXPECT_EQ(beyond.status, 0) << beyond.err;
    const Json shares = told(tune("learned", {"--json"}))["unfamiliar"];
    EXPECT_LT(shares["before"], 0.1);
    EXPECT_GT(shares["tuned"], 0.8);
    EXPECT_THAT(beyond.out, HasSubstr("Note: Tuned, in "));
    EXPECT_THAT(beyond.out,
                HasSubstr(" % of the time some robot is driven as its network has not learned (before in "));
    EXPECT_THAT(read("learned/report.html"), HasSubstr("some robot is driven as its network has not learned"));
}

TEST_F(TuneProgram, SettingsAreForRunsBatchesAndExperiments) {
    ASSERT_EQ(tune("out").status, 0);
    const std::string settings = path("out/settings.toml"), scenario = path("s.toml");
    const Json tuned = told(tune("out", {"--json"}));
    const std::string set = "robot[1].controller.commands[1].v_mps=" + tuned["parameters"][0]["tuned"].dump();
    const Json bySettings = told(runMrose({"run", scenario, "--settings", settings, "--json"}));
    EXPECT_EQ(bySettings["world_hash"], told(runMrose({"run", scenario, "--set", set, "--json"}))["world_hash"]);
    EXPECT_NE(bySettings["world_hash"], told(runMrose({"run", scenario, "--json"}))["world_hash"]);
    // What is given beside them holds.
    EXPECT_EQ(told(runMrose({"run", scenario, "--settings", settings, "--set",
                             "robot[1].controller.commands[1].v_mps=0.4", "--json"}))["world_hash"],
              told(runMrose({"run", scenario, "--json"}))["world_hash"]);

    ASSERT_EQ(runMrose({"batch", scenario, "--trials", "2", "--settings", settings, "-o", path("batch")}).status, 0);
    EXPECT_THAT(read("batch/results.csv"), HasSubstr("--settings"));
    ASSERT_EQ(runMrose({"experiment", path("x.toml"), "--settings", settings, "-o", path("tuned")}).status, 0);
    ASSERT_EQ(runMrose({"experiment", path("x.toml"), "--set", set, "-o", path("set")}).status, 0);
    const auto bySettingsRows = csvRows(read("tuned/results.csv")), bySetRows = csvRows(read("set/results.csv"));
    ASSERT_EQ(bySettingsRows.size(), 6u);
    for (std::size_t i = 0; i < bySettingsRows.size(); ++i)
        EXPECT_EQ(bySettingsRows[i].at("world_hash"), bySetRows[i].at("world_hash"));
    EXPECT_THAT(bySettingsRows[0].at("command"), HasSubstr(" --settings "));
    EXPECT_THAT(bySettingsRows[0].at("window"), HasSubstr(" --settings "));
    const auto listed = readTrials(path("tuned/results.csv"));
    ASSERT_TRUE(listed) << listed.error().message();
    EXPECT_EQ(listed->rows[0].request.settings, std::vector<std::string>{settings});
}

TEST_F(TuneProgram, ItsRowsAreRepeatedByTheirCommands) {
    ASSERT_EQ(tune("out").status, 0);
    const auto rows = csvRows(read("out/results.csv"));
    const std::string& command = rows[rows.size() / 2].at("command");
    const ProgramResult alone =
        RunningProgram({"/bin/sh", "-c", replaced(command, "mrose ", mroseProgram() + ' ') + " --json"}).finish();
    EXPECT_EQ(told(alone)["world_hash"], rows[rows.size() / 2].at("world_hash")) << command;
}

TEST_F(TuneProgram, KilledItGoesOnWhereItWas) {
    // As many seeds as it takes to be caught under way.
    const std::string experiment = read("x.toml");
    int status = 0;
    for (int seeds = 20; status == 0 && seeds < 5000; seeds *= 4) {
        std::filesystem::remove_all(path("parts"));
        write("x.toml", replaced(experiment, "seeds = 2", "seeds = " + std::to_string(seeds)));
        RunningProgram running({mroseProgram(), "tune", path("t.toml"), "-o", path("parts")});
        if (running.waitForError(" evaluations")) running.send(SIGKILL);
        status = running.finish().status;
    }
    ASSERT_EQ(status, 128 + SIGKILL);
    const std::string part = read("parts/results.part.csv");
    EXPECT_EQ(told(tune("parts", {"--json"}))["resumed"], std::count(part.begin(), part.end(), '\n'));
    EXPECT_EQ(told(tune("once", {"--json"}))["resumed"], 0);
    for (const char* name : {"results.csv", "candidates.csv"})
        EXPECT_EQ(read(std::string("parts/") + name), read(std::string("once/") + name)) << name;
}

TEST_F(TuneProgram, WhatIsWrongIsOneLine) {
    expectOneLine(runMrose({"tune", path("nothing.toml"), "-o", path("out")}), {"nothing.toml"});
    expectOneLine(runMrose({"tune", path("x.toml"), "-o", path("out")}), {"x.toml:1:10: format: "});
    expectOneLine(runMrose({"run", path("t.toml")}), {"t.toml:1:10: format: "});
    write("bad.toml", "format = \"mrose settings\"\nversion = 1\n[set]\n\"robot[1].controller.sped\" = 1.0\n");
    for (const std::string& of : {path("s.toml"), path("x.toml")})
        expectOneLine(runMrose({"run", of, "--settings", path("bad.toml")}),
                      {"bad.toml:4:30: robot[1].controller.sped: ", "is not a known key"});
    write("bad.toml", "format = \"mrose settings\"\nversion = 1\n[set]\n\"robot[4].start.x_m\" = 1.0\n");
    expectOneLine(runMrose({"batch", path("s.toml"), "--settings", path("bad.toml"), "-o", path("out")}),
                  {"bad.toml:4:24: robot[4].start.x_m: names nothing that there is"});
    expectOneLine(runMrose({"run", path("s.toml"), "--settings", path("s.toml")}), {"s.toml:1:10: format: "});
    expectOneLine(runMrose({"run", path("s.toml"), "--settings", path("none.toml")}), {"none.toml"});
    EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(TuneProgram, TheFolderOfAnotherTuningIsRefused) {
    ASSERT_EQ(tune("out").status, 0);
    write("t.toml", replaced(read("t.toml"), "to = 0.5", "to = 0.45"));
    expectOneLine(tune("out"), {path("out") + ": holds other results: the content of the tuning has changed"});
}

TEST_F(TuneProgram, FilesThatAreNotItsOwnAreNotReplaced) {
    write("mine/settings.toml", "precious");
    expectOneLine(tune("mine"), {path("mine") + "/settings.toml: is there already"});
    EXPECT_EQ(read("mine/settings.toml"), "precious");
}

/// The shipped file, smaller.
TEST_F(TuneProgram, TheSpeedsOfGoToPose) {
    write("small.toml", R"(format = "mrose tuning"
version = 1
name = "speed"
experiment = "time_to_target.toml"
trials = 16
held_out = 40
evaluations = 200
cost = "time_s"
[[parameter]]
name = "speed"
path = "robot[1].controller.speed_mps"
from = 0.1
to = 0.4
start = 0.2
)");
    const Json json = told(runMrose({"tune", path("small.toml"), "-o", path("out"), "--quiet", "--json"}));
    EXPECT_GT(json["parameters"][0]["tuned"], 0.3) << "slow is not soon";
    EXPECT_LT(json["held_out"]["change"]["high"], -1);
    const ProgramResult shipped =
        runMrose({"tune", "go_to_pose_tuning.toml", "-o", path("sh/ut/x"), "--threads", "-1"});
    EXPECT_EQ(shipped.status, 2) << "a wrong flag is found before the work";
}

}  // namespace
}  // namespace mrose
