// Experiments whose variants begin where a run branches.
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "experiment/experiment_fixture.h"
#include "experiment/trial.h"
#include "io/format.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using namespace experiment_test;
using testing::HasSubstr;

constexpr const char* branching = R"(trials = 3
seeds = 2
duration_s = 2.0
branch = 'robot[1].x > draw.x + draw.far'
branch_within_s = 3.0
[[draw]]
name = "x"
path = "robot[1].start.x_m"
from = -3.0
to = 3.0
[[draw]]
name = "far"
from = 0.2
to = 0.6
[[variant]]
name = "on"
[[variant]]
name = "it stands"
set = { "robot[1].controller" = { kind = "wander", speed_mps = 0.0, rotation_degps = 0.0 } }
[features]
at = 'time'
gone = 'robot[1].x - draw.x'
[measures]
way = 'robot[1].x - draw.x'
lasts = 'time - draw.branch_s'
)";

TEST_F(ExperimentTest, VariantsGoOnFromCopiesOfOneStateWhereATrialBranches) {
    const auto summary = run(experiment(branching));
    ASSERT_TRUE(summary) << summary.error().message();
    const auto all = rows();
    ASSERT_EQ(all.size(), 12u);
    std::set<std::string> hashes;
    for (std::size_t i = 0; i < all.size(); i += 4)
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& row = all[i + k];
            // They branched once, whatever the seed.
            EXPECT_EQ(row.at("feature.at"), all[i].at("feature.at"));
            EXPECT_EQ(row.at("feature.gone"), all[i].at("feature.gone"));
            const double gone = number(row.at("feature.gone")), far = number(row.at("draw.far"));
            EXPECT_TRUE(gone > far && gone < far + 0.02) << gone << ' ' << far;
            EXPECT_NEAR(number(row.at("feature.at")), far / 0.4, 0.1);
            EXPECT_NEAR(number(row.at("measure.lasts")), 2, 1e-9);
            EXPECT_NEAR(number(row.at("time_s")), number(row.at("feature.at")) + 2, 1e-9);
            // A control period at the most until the other commands are given: 4 cm.
            const double way = number(row.at("measure.way")) - gone;
            if (row.at("variant_name") == "on")
                EXPECT_NEAR(way, 0.8, 0.05);
            else
                EXPECT_NEAR(way, 0, 0.041);
            hashes.insert(row.at("world_hash"));
        }
    EXPECT_EQ(hashes.size(), 12u) << "each seed is another noise from there on";
}

/// The variant that changes nothing is the run that never branched.
TEST_F(ExperimentTest, ABranchThatChangesNothingGoesOnAsTheRunItself) {
    const Experiment lane = experiment(branching);
    ASSERT_TRUE(run(lane));
    Experiment whole = lane;
    whole.branch = {};
    whole.variants.resize(1);
    whole.measures.pop_back();
    std::uint32_t checked = 0;
    for (const auto& row : rows()) {
        const auto number = static_cast<std::uint32_t>(std::stoul(row.at("trial")));
        if (row.at("variant") != "1" || row.at("seed") != std::to_string(whole.noiseSeed(number, 0))) continue;
        ++checked;
        TrialExpressions expressions(whole);
        auto trial = TrialMaker(whole, expressions, {}).make(number);
        ASSERT_TRUE(trial);
        const Scenario scenario(std::move(trial->scenarios[0].parts));
        RunOptions options;
        options.duration = fromSeconds(std::stod(row.at("time_s")));
        const auto result = mrose::run(scenario, scenario.initialState(), options);
        ASSERT_TRUE(result);
        EXPECT_EQ(hexadecimal(hashOf(result->state).world), row.at("world_hash"));
    }
    EXPECT_EQ(checked, lane.trials);
}

TEST_F(ExperimentTest, ATrialThatDoesNotBranchIsARowThatSaysSo) {
    std::string text = branching;
    text.replace(text.find("'robot[1].x > draw.x + draw.far'"), 32, "'draw.far > 0.4 and time > 0.5'");
    const auto summary = run(experiment(text));
    ASSERT_TRUE(summary) << summary.error().message();
    std::set<std::string> ends;
    for (const auto& row : rows()) {
        const bool branches = number(row.at("draw.far")) > 0.4;
        EXPECT_EQ(row.at("end"), branches ? "duration" : "no branch");
        EXPECT_EQ(row.at("feature.at") == "nan", !branches);
        EXPECT_EQ(row.at("measure.way") == "nan", !branches);
        EXPECT_NEAR(number(row.at("time_s")), branches ? 2.52 : 3, 1e-9);
        ends.insert(row.at("end"));
    }
    EXPECT_EQ(ends.size(), 2u);
}

TEST_F(ExperimentTest, ABranchThatCannotBeAskedIsAFaultOfItsTrial) {
    std::string text = branching;
    text.replace(text.find("'robot[1].x > draw.x + draw.far'"), 32, "'time > 0.5 and (draw.far < 0.4 or 5)'");
    const auto summary = run(experiment(text));
    ASSERT_TRUE(summary) << summary.error().message();
    std::set<std::string> ends;
    for (const auto& row : rows()) {
        const bool wrong = number(row.at("draw.far")) >= 0.4;
        EXPECT_EQ(row.at("end"), wrong ? "fault" : "duration");
        EXPECT_EQ(row.at("fault").find("branch: gives the number 5") != std::string::npos, wrong) << row.at("fault");
        EXPECT_EQ(row.at("measure.way") == "nan", wrong);
        ends.insert(row.at("end"));
    }
    EXPECT_EQ(ends.size(), 2u);
}

TEST_F(ExperimentTest, WhatIsWrongWithABranchIsOneLine) {
    EXPECT_THAT(refusedRun("trials = 1\nbranch = 'robot[1].sped > 1'\n"),
                testing::StartsWith("x.toml:6:20: branch: there is no 'sped'"));
    EXPECT_THAT(refusedRun("trials = 1\nbranch = '1 + 1'\n"), HasSubstr("branch: gives the number 2"));
    EXPECT_THAT(refusal("trials = 1\nbranch_within_s = 3.0\n"),
                HasSubstr("x.toml:6:19: branch_within_s: is there without `branch`"));
    EXPECT_THAT(refusal("trials = 1\nbranch = 'time > 1'\n[[draw]]\nname = \"branch_s\"\nfrom = 0\nto = 1\n"),
                HasSubstr("draw[\"branch_s\"].name: is what expressions call the instant of the branch"));
    EXPECT_THAT(refusedRun("trials = 1\n[measures]\nm = 'draw.branch_s'\n"), HasSubstr("there is no draw 'branch_s'"));
}

}  // namespace
}  // namespace mrose
