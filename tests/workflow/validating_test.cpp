// What ships is validated, and each of its runs is repeated and opened as its row says.
#include <fstream>
#include <iterator>

#include "experiment/run.h"
#include "io/format.h"
#include "scenario/description_library.h"
#include "support/places.h"
#include "support/workshop.h"
#include "validation/validation_file.h"
#include "workflow/expect_error.h"
#include "workflow/open_scenario.h"
#include "workflow/read_trials.h"
#include "workflow/resources.h"
#include "workflow/validate_behaviour.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using Validating = Workshop;

TEST_F(Validating, ShippedValidationRunsAndEachRunIsRepeated) {
    ValidateRequest request{"faster_turns.toml", path("out"), 3};
    request.seconds = [] { return 90.0; };
    const auto validated = validateBehaviour(request);
    ASSERT_TRUE(validated) << validated.error().message();
    ASSERT_TRUE(validated->result);
    EXPECT_EQ(validated->summary.runs, 12);
    EXPECT_EQ(listing(), (std::vector<std::string>{"out", "out/batch.txt", "out/disagreements.csv", "out/report.html",
                                                   "out/results.csv", "out/validation.csv"}));
    EXPECT_NE(read("out/report.html").find("1.50 min of this validation"), std::string::npos);
    EXPECT_NE(read("out/validation.csv").find("share of the gain that survives"), std::string::npos);
    // 200 runs of 60 s.
    EXPECT_FALSE(validated->result->account.fromNetworks);
    EXPECT_EQ(validated->result->account.logMinutes, 200);
    const auto trials = readTrials(path("out/disagreements.csv"));
    ASSERT_TRUE(trials) << trials.error().message();
    EXPECT_EQ(trials->rows.size(), 2 * validated->result->disagreements.size());
    const auto all = readTrials(path("out/results.csv"));
    ASSERT_TRUE(all) << all.error().message();
    const auto hash = std::ranges::find(all->columns, "world_hash") - all->columns.begin();
    for (const std::size_t row : {0u, 4u, 7u, 11u}) {
        const OpenRequest& opened = all->rows[row].request;
        ScenarioRequest one{opened.file};
        one.trial = opened.trial, one.variant = opened.variant;
        const auto scenario = openScenario(one);
        ASSERT_TRUE(scenario) << scenario.error().message();
        RunOptions options;
        options.duration = fromSeconds(all->rows[row].end);
        const auto run = mrose::run(*scenario->scenario, scenario->scenario->initialState(*opened.seed), options);
        ASSERT_TRUE(run) << run.error().message();
        EXPECT_EQ(hexadecimal(hashOf(run->state).world), all->rows[row].cells[static_cast<std::size_t>(hash)]) << row;
    }
    const auto again = validateBehaviour(request);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->summary.resumed, 12);
}

TEST_F(Validating, LogsAreCountedByTheNetworksWhereTheFileDoesNotSay) {
    std::ifstream shipped(sourceFolder() / "resources/experiments/faster_turns.toml");
    std::string text(std::istreambuf_iterator<char>(shipped), {});
    const std::string said = "log_minutes = 200\n";
    ASSERT_NE(text.find(said), std::string::npos);
    text.erase(text.find(said), said.size());
    const auto validated = validateBehaviour({write("own.toml", text), path("out"), 2});
    ASSERT_TRUE(validated) << validated.error().message();
    ASSERT_TRUE(validated->result);
    // Patterns, without the first seconds of each run.
    ASSERT_TRUE(validated->result->account.fromNetworks);
    EXPECT_GT(*validated->result->account.logMinutes, 140);
    EXPECT_LT(*validated->result->account.logMinutes, 200);
}

/// What `mrose learn` makes of trials does not say which they were.
TEST_F(Validating, LearnedFilesOfUnknownTrialsAreNoted) {
    std::ifstream shipped(sourceFolder() / "resources/experiments/planner_choice_validation.toml");
    const std::string text(std::istreambuf_iterator<char>(shipped), {}), said = "used_trials = [[1, 3000]]\n";
    ASSERT_NE(text.find(said), std::string::npos);
    const auto notes = [&](const std::string& content) {
        DiskDescriptions source = openDescriptions();
        const auto file = DescriptionLibrary(source).file(write("own.toml", content), {});
        const auto validation = file ? readValidation(*file, source) : tl::unexpected(file.error());
        EXPECT_TRUE(validation) << validation.error().message();
        return validation ? validation->notes : std::vector<std::string>{};
    };
    EXPECT_TRUE(notes(text).empty());
    std::string silent = text;
    EXPECT_EQ(notes(silent.erase(silent.find(said), said.size())),
              (std::vector<std::string>{"It is not said which trials \"chosen\" was learned from (`used_trials`): they "
                                        "may be among these."}));
}

TEST_F(Validating, WhatCannotBeValidatedSaysWhy) {
    expectError(validateBehaviour({"nothing.toml", path("out")}), "nothing.toml", {"does not exist"});
    const auto other = validateBehaviour({"time_to_target.toml", path("out")});
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().message().find(
                  "time_to_target.toml:6:10: format: is \"mrose experiment\"; expected one of \"mrose validation\""),
              std::string::npos)
        << other.error().message();
    expectError(validateBehaviour({"faster_turns.toml", path("out"), 500}), "", {"--trials", "400 trials"});
    EXPECT_TRUE(listing().empty());
    ExperimentWatch ended;
    ended.goesOn = [] { return false; };
    const auto part = validateBehaviour({"faster_turns.toml", path("out"), 2}, ended);
    ASSERT_TRUE(part) << part.error().message();
    EXPECT_FALSE(part->summary.complete);
    EXPECT_FALSE(part->result);
    EXPECT_EQ(read("out/report.html"), "");
}

}  // namespace
}  // namespace mrose
