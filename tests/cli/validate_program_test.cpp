// `mrose validate` as its users run it.
#include <algorithm>
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

/// The robot of the lane drives 1.6 m before, and 1 m after; in the reality it is a tenth slower.
constexpr const char* slower = R"(format = "mrose validation"
version = 1
name = "slower"
experiment = "x.toml"
trials = 20
first_trial = 101
[before]
[after]
name = "slow"
set = { "robot[1].controller.commands[1].v_mps" = 0.25 }
[reality]
set = { "robot[1].type.kinematics.v" = { gain = 0.9 } }
[[measure]]
name = "off"
better = "less"
unit = "m"
)";

class ValidateProgram : public GameFolder {
protected:
    ValidateProgram() {
        Lane lane;
        for (const auto& [name, text] : lane.texts) write(name, text);
        write("v.toml", slower);
    }
    ProgramResult validate(const std::string& folder, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"validate", path("v.toml"), "-o", path(folder), "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return runMrose(words);
    }
    std::string refusal(const std::string& from, const std::string& to) {
        write("v.toml", replaced(slower, from, to));
        const ProgramResult result = validate("refused");
        EXPECT_NE(result.status, 0);
        EXPECT_FALSE(std::filesystem::exists(path("refused")));
        return result.err;
    }
};

TEST_F(ValidateProgram, SaysWhatOfTheGainSurvives) {
    const ProgramResult result = validate("out");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("gain ratio, reality over simulation: "));
    EXPECT_THAT(result.out, HasSubstr("; 20 trials"));
    EXPECT_THAT(result.out, HasSubstr(path("out") + "/report.html; mrose-gui " + path("out") + "/disagreements.csv"));
    for (const char* name : {"results.csv", "report.html", "validation.csv", "disagreements.csv"})
        EXPECT_NE(read(std::string("out/") + name), "") << name;

    const Json again = told(validate("out", {"--json"}));
    const Json& off = again["measures"].at(0);
    // Where it starts and its noise shift it by centimetres: |1.6 - 1| less |1 - 1|, and |1.44 - 1| less |0.9 - 1|.
    EXPECT_NEAR(off["gain_in_simulation"]["value"], 0.53, 0.06);
    EXPECT_NEAR(off["gain_in_reality"]["value"], 0.33, 0.06);
    EXPECT_NEAR(double{off["survives"]["value"]},
                double{off["gain_in_reality"]["value"]} / double{off["gain_in_simulation"]["value"]}, 1e-9);
    EXPECT_LT(off["gain_in_simulation"]["low"], off["gain_in_simulation"]["value"]);
    EXPECT_EQ(again["cells"].size(), 4u);
    EXPECT_EQ(again["synthetic_reality"], true);
}

TEST_F(ValidateProgram, SaysWhichTrialsAreLeftOutAndWhy) {
    write("v.toml", std::string(slower) + "[[measure]]\nname = \"never\"\nbetter = \"less\"\n");
    EXPECT_THAT(validate("out").out,
                HasSubstr("; 0 trials, 20 more left out: not all of their runs gave a number for never\n"));
}

TEST_F(ValidateProgram, SaysInWhichCellFaultsLeftRunsOut) {
    ASSERT_EQ(validate("out").status, 0);
    // As if the controller had failed in two of them.
    std::string rows = read("out/results.csv");
    for (int k = 0; k < 2; ++k) rows = replaced(rows, ",slow in simulation,duration,", ",slow in simulation,fault,");
    write("out/results.csv", rows);
    const ProgramResult again = validate("out");
    EXPECT_THAT(again.out, HasSubstr("slow in simulation: a fault ended 2 of 40 runs, which are left out\n"));
    const Json json = told(validate("out", {"--json"}));
    EXPECT_EQ(json["cells"][1]["ended_by_fault"], 2);
    EXPECT_EQ(json["cells"][0]["ended_by_fault"], 0);
}

TEST_F(ValidateProgram, WhereTheyDisagreeIsRepeatedByItsCommand) {
    ASSERT_EQ(validate("out", {"--trials", "8"}).status, 0);
    const auto rows = csvRows(read("out/disagreements.csv"));
    ASSERT_FALSE(rows.empty());
    const std::string command = replaced(rows[0].at("command"), "mrose ", mroseProgram() + ' ') + " --json";
    EXPECT_EQ(told(RunningProgram({"/bin/sh", "-c", command}).finish())["world_hash"], rows[0].at("world_hash"));
    const auto listed = readTrials(path("out/disagreements.csv"));
    ASSERT_TRUE(listed) << listed.error().message();
    EXPECT_EQ(listed->rows.size(), rows.size());
}

TEST_F(ValidateProgram, MoreTrialsGoOnAndFewerAreRefused) {
    ASSERT_EQ(validate("out", {"--trials", "8"}).status, 0);
    const Json all = told(validate("out", {"--json"}));
    EXPECT_EQ(all["measures"].at(0)["trials"], 20);
    ASSERT_EQ(validate("at once").status, 0);
    EXPECT_EQ(read("out/validation.csv"), read("at once/validation.csv"));
    const ProgramResult fewer = validate("out", {"--trials", "8"});
    EXPECT_EQ(fewer.status, 1);
    EXPECT_THAT(fewer.err, HasSubstr(path("out")));
}

TEST_F(ValidateProgram, WhatIsWrongIsToldInOneLine) {
    EXPECT_THAT(refusal("name = \"off\"", "name = \"of\""),
                HasSubstr("v.toml:14:8: measure[\"of\"].name: is no measure of the experiment"));
    EXPECT_THAT(refusal("commands[1].v_mps", "commands[2].v_mps"), HasSubstr("v.toml:10:"));
    EXPECT_THAT(refusal("x.toml", "y.toml"), HasSubstr("y.toml"));
    EXPECT_THAT(refusal("[reality]", "[unreality]"), HasSubstr("reality: says nothing of the reality"));
    for (const char* to : {"better = \"more or less\"", "better = 1"})
        EXPECT_EQ(std::ranges::count(refusal("better = \"less\"", to), '\n'), 1) << to;
}

}  // namespace
}  // namespace mrose
