// What experiments measure.
#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "behaviour/command_player.h"
#include "experiment/experiment_fixture.h"
#include "experiment/trial.h"
#include "io/format.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using namespace experiment_test;
using testing::HasSubstr;

TEST_F(ExperimentTest, TrialEndsWhereItsConditionHoldsAndMeasuresLookAtAllOfIt) {
    const Experiment lane = experiment(
        "trials = 3\nuntil = 'robot[1].x > 1'\n[measures]\nend_x = 'robot[1].x'\nfarthest = { most = 'robot[1].x' }\n"
        "nearest = { least = 'robot[1].x' }\nlate = { seconds = 'robot[1].x > 0.5' }\n"
        "half = { first = 'robot[1].x > 0.5' }\nnever = { first = 'robot[1].x > 9' }\n"
        "thirds = { times = 'robot[1].x % 0.3 < 0.1' }\nmean = { mean = 'robot[1].x' "
        "}\n");
    ASSERT_TRUE(run(lane));
    for (const auto& row : rows()) {
        EXPECT_EQ(row.at("end"), "condition");
        const double end = number(row.at("time_s"));
        EXPECT_NEAR(end, 2.5, 0.1) << "1 m at 0.4 m/s";
        EXPECT_GT(number(row.at("measure.end_x")), 1);
        EXPECT_EQ(row.at("measure.end_x"), row.at("measure.farthest"));
        EXPECT_LT(number(row.at("measure.nearest")), 0.01);
        EXPECT_NEAR(number(row.at("measure.half")), 1.25, 0.06);
        EXPECT_NEAR(number(row.at("measure.late")), end - number(row.at("measure.half")) + 0.02, 1e-9);
        EXPECT_EQ(row.at("measure.never"), "nan");
        EXPECT_EQ(row.at("measure.thirds"), "4.0") << "from 0, 0.3, 0.6 and 0.9 m on";
        EXPECT_NEAR(number(row.at("measure.mean")), 0.5, 0.02);
    }
    // Looked at every second, it ends at a whole one.
    const Experiment rarely = experiment("trials = 3\nevery_s = 1.0\nuntil = 'robot[1].x > 1'\n");
    ASSERT_TRUE(run(rarely, "rarely"));
    for (const auto& row : rows("rarely")) EXPECT_EQ(row.at("time_s"), "3.0");
}

/// What several ask is asked once, and is what it would be if each asked by itself.
TEST_F(ExperimentTest, SharedQuestionsGiveWhatTheyGiveAlone) {
    const Experiment lane = experiment(
        "trials = 3\nuntil = 'robot[1].x > 1.2'\n[measures]\n"
        "over = { first = 'robot[1].x > 1.2' }\nover_alone = { first = '(robot[1].x > 1.2)' }\n"
        "half = { seconds = 'robot[1].x > 0.5' }\nhalves = { times = 'robot[1].x > 0.5' }\n"
        "half_alone = { seconds = '(robot[1].x > 0.5)' }\nat_end = 'robot[1].x > 0.5'\n"
        "mean = { mean = 'robot[1].x' }\nmost = { most = 'robot[1].x' }\nmean_alone = { mean = '(robot[1].x)' }\n");
    ASSERT_TRUE(run(lane));
    for (const auto& row : rows()) {
        EXPECT_EQ(row.at("end"), "condition");
        EXPECT_EQ(row.at("measure.over"), row.at("time_s"));
        EXPECT_EQ(row.at("measure.over"), row.at("measure.over_alone"));
        EXPECT_GT(number(row.at("measure.half")), 1);
        EXPECT_EQ(row.at("measure.half"), row.at("measure.half_alone"));
        EXPECT_EQ(row.at("measure.halves"), "1.0");
        EXPECT_EQ(row.at("measure.at_end"), "1.0");
        EXPECT_EQ(row.at("measure.mean"), row.at("measure.mean_alone"));
        EXPECT_GT(number(row.at("measure.most")), 1.2);
    }
}

/// What a trial alone makes wrong is in its rows; the others go on.
TEST_F(ExperimentTest, ATrialThatCannotBeMeasuredIsARowThatSaysWhy) {
    const std::string measures = "[features]\nat = 'draw.x'\n[measures]\nway = 'robot[1].x'\n";
    const auto expectFaults = [&](const std::string& text, const std::string& says) {
        const auto summary = run(experiment(text), says);
        ASSERT_TRUE(summary) << summary.error().message();
        EXPECT_TRUE(summary->complete);
        std::int64_t faulty = 0;
        for (const auto& row : rows(says)) {
            const bool wrong = number(row.at("draw.x")) > 0;
            faulty += wrong ? 1 : 0;
            EXPECT_EQ(row.at("end"), wrong ? "fault" : "duration");
            EXPECT_EQ(row.at("fault").find(says) != std::string::npos, wrong) << row.at("fault");
            EXPECT_EQ(row.at("measure.way") == "nan", wrong);
            EXPECT_EQ(row.at("feature.at"), row.at("draw.x"));
        }
        EXPECT_GT(faulty, 0);
        EXPECT_LT(faulty, 12);
        EXPECT_EQ(summary->variants[0].faulty, faulty);
    };
    expectFaults("until = 'draw.x > 0 and time > 1 and 5'\n" + (drawn + measures), "until: gives the number 5");
    expectFaults(drawn + measures + "a = 'draw.x > 0 and time > 1 and \"five\" or 1'\n", "measures.a: gives");
    expectFaults(drawn + measures + "a = { most = 'draw.x > 0 and time > 1 and \"five\" or 1' }\n",
                 "measures.a.most: gives");
}

TEST_F(ExperimentTest, ATrialThatCannotBeMadeIsARowThatSaysWhy) {
    const Experiment lane = experiment(
        "trials = 40\nseeds = 2\n[[draw]]\nname = \"m\"\npath = \"robot[1].type.mass_kg\"\nmean = 1.0\ndeviation = "
        "0.8\n"
        "[measures]\nway = 'robot[1].x'\n");
    const auto summary = run(lane);
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_TRUE(summary->complete);
    ASSERT_EQ(rows().size(), 80u);
    std::int64_t faulty = 0;
    for (const auto& row : rows()) {
        if (row.at("end") != "fault") continue;
        ++faulty;
        EXPECT_THAT(row.at("fault"), testing::StartsWith("x.toml:8:8: draw[\"m\"]: mass_kg: is "));
        EXPECT_THAT(row.at("fault"), HasSubstr("(trial " + row.at("trial") + ")"));
        EXPECT_EQ(row.at("measure.way"), "nan");
        EXPECT_EQ(row.at("draw.m"), "");
    }
    EXPECT_GT(faulty, 0);
    EXPECT_LT(faulty, 40);
    EXPECT_EQ(summary->variants[0].faulty, faulty);
    const std::string& first = summary->variants[0].firstFault;
    EXPECT_THAT(first, testing::MatchesRegex("x.toml:8:8: [^()]*\\(trial [0-9]+\\)")) << "said once";
}

/// As where a plug-in is built anew meanwhile: it goes on once it is there again.
TEST_F(ExperimentTest, WhatIsNoFaultOfATrialEndsTheExperiment) {
    const std::string script = "{ kind = \"velocity_script\", commands = [{ t_s = 0, v_mps = 0.4 }] }";
    scenario_.replace(scenario_.find(script), script.size(), "{ kind = \"plugin\", library = \"p.so\" }");
    std::atomic<bool> missing = false;
    options_.progress = [&](std::int64_t done, std::int64_t) { missing = done >= 10; };
    options_.loading.plugins = [&](const std::string&,
                                   const std::string&) -> Expected<std::shared_ptr<const Controller>> {
        if (missing) return fail("p.so", "there is no such file");
        return std::make_shared<const CommandPlayer>(std::vector<StampedCommand>{{0, {0.4, 0}}});
    };
    const Experiment lane = experiment(
        "trials = 40\n[[draw]]\nname = \"x\"\npath = \"robot[1].start.x_m\"\nfrom = -1.0\nto = 1.0\n"
        "[measures]\nway = 'robot[1].x'\n");
    const auto ended = run(lane);
    ASSERT_FALSE(ended);
    EXPECT_THAT(ended.error().message(), HasSubstr("there is no such file"));
    options_.progress = {};
    missing = false;
    const auto summary = run(lane);
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_TRUE(summary->complete);
    EXPECT_GE(summary->resumed, 10);
    EXPECT_LT(summary->resumed, 40);
    EXPECT_EQ(summary->variants[0].faulty, 0);
    EXPECT_EQ(rows().size(), 40u);
}

/// As far as the first trial's start tells: what any trial would have.
TEST_F(ExperimentTest, WhatNoTrialCanAnswerIsToldBeforeTheFirst) {
    EXPECT_THAT(refusedRun("trials = 1\nuntil = '5'\n"), HasSubstr("x.toml:6:9: until: gives the number 5"));
    EXPECT_THAT(refusedRun("trials = 1\n[measures]\na = { seconds = '5' }\n"), HasSubstr("gives the number 5"));
}

TEST_F(ExperimentTest, MeasuresTellTheLongestStretchAndReadThoseAboveThem) {
    const Experiment lane = experiment(
        "trials = 3\n[measures]\nlongest = { longest = 'robot[1].x % 0.3 < 0.1 or robot[1].x > 1.2' }\n"
        "all = { longest = 'time > 0' }\nnever = { longest = 'robot[1].x > 9' }\n"
        "half = { first = 'robot[1].x > 0.5' }\nuntil_half = { seconds = 'robot[1].x <= 0.5' }\n"
        "sum = 'measure.half + measure.longest'\nlate = 'measure.sum > 1 and measure.never == 0'\n");
    ASSERT_TRUE(run(lane));
    for (const auto& row : rows()) {
        EXPECT_NEAR(number(row.at("measure.longest")), 1, 0.2) << "from 1.2 m on to the end at 1.6 m";
        EXPECT_EQ(row.at("measure.all"), "4.0");
        EXPECT_EQ(row.at("measure.never"), "0.0");
        EXPECT_EQ(number(row.at("measure.sum")), number(row.at("measure.half")) + number(row.at("measure.longest")));
        EXPECT_EQ(row.at("measure.late"), "1.0");
    }
    EXPECT_THAT(refusedRun("trials = 1\n[measures]\na = 'measure.b'\nb = 'time'\n"),
                HasSubstr("x.toml:7:14: measures.a: there is no measure above 'b': there is none"));
    EXPECT_THAT(refusedRun("trials = 1\n[measures]\nb = 'time'\na = { most = 'measure.b' }\n"),
                HasSubstr("'measure' is known in measures at a trial's end alone"));
    EXPECT_THAT(refusedRun("trials = 1\nuntil = 'measure.b > 1'\n[measures]\nb = 'time'\n"),
                HasSubstr("'measure' is known in measures at a trial's end alone"));
}

/// The ends of Wilson's interval are the shares from which what was found is just z standard deviations off.
TEST_F(ExperimentTest, SharesHaveTheirIntervals) {
    const Experiment lane = experiment(
        "trials = 40\n[[draw]]\nname = \"u\"\nfrom = 0.0\nto = 1.0\n[measures]\n"
        "some = 'draw.u < 0.3'\nall = 'time > 0'\nnumber = 'draw.u'\nalways = { mean = 'time >= 0' }\n");
    const auto summary = run(lane);
    ASSERT_TRUE(summary) << summary.error().message();
    const auto& measures = summary->variants[0].measures;
    for (const MeasureSummary& measure : {measures[0], measures[1]}) {
        ASSERT_TRUE(measure.share) << measure.name;
        for (const double end : {measure.estimate.low, measure.estimate.high})
            if (end < 1) {
                EXPECT_NEAR(std::abs(measure.mean - end), 1.959964 * std::sqrt(end * (1 - end) / 40), 1e-7);
            }
        EXPECT_LT(measure.estimate.low, measure.mean);
    }
    EXPECT_GT(measures[0].estimate.high, measures[0].mean);
    EXPECT_EQ(measures[1].estimate.high, 1);
    EXPECT_FALSE(measures[2].share);
    EXPECT_FALSE(measures[3].share) << "a mean over looks, though it is 1 in all runs";
    EXPECT_EQ(measures[3].estimate.low, 1);
    // Student's quantile of 39 degrees of freedom.
    EXPECT_NEAR(measures[2].estimate.high - measures[2].mean, 2.02269 * measures[2].deviation / std::sqrt(40), 1e-5);
}

/// Of three trials Student's intervals reach beyond 0 and 1.
TEST_F(ExperimentTest, IntervalsEndWhereMeasuresCannotBe) {
    const Experiment lane = experiment(
        "trials = 3\n[[draw]]\nname = \"u\"\nfrom = 0.0\nto = 1.0\n[features]\nu = 'draw.u'\n[measures]\n"
        "late_s = { seconds = 'time > 4 * draw.u' }\nwhen_s = { first = 'time > 4 * draw.u' }\n"
        "share = { mean = 'time > 4 * draw.u' }\n"
        "percent = { mean = 'time > 4 * draw.u and 100 or 0' }\nany = { mean = '(time > 4 * draw.u and 1 or 0) + 0' "
        "}\n");
    const auto summary = run(lane);
    ASSERT_TRUE(summary) << summary.error().message();
    const auto& of = summary->variants[0].measures;
    EXPECT_LT(of[0].estimate.low, 0) << "of a feature whose text does not say what it can be";
    for (const std::size_t place : {1u, 2u}) {
        EXPECT_EQ(of[place].estimate.low, 0) << of[place].name;
        EXPECT_GT(of[place].estimate.high, of[place].mean) << of[place].name;
    }
    EXPECT_EQ(of[3].estimate.low, 0);
    EXPECT_EQ(of[3].estimate.high, 1);
    EXPECT_EQ(of[4].estimate.low, 0);
    EXPECT_EQ(of[4].estimate.high, 100);
    EXPECT_LT(of[5].estimate.low, 0);
    EXPECT_GT(of[5].estimate.high, 1);
}

/// Runs of a trial that are all alike say no more than one.
TEST_F(ExperimentTest, RunsOfATrialCountAsOneWhereTheyAreAlike) {
    const std::string text =
        "trials = 40\n[[draw]]\nname = \"u\"\nfrom = 0.0\nto = 1.0\n[measures]\nsome = 'draw.u < 0.3'\nnumber = "
        "'draw.u'\n";
    const auto once = run(experiment(text), "once"), often = run(experiment("seeds = 5\n" + text), "often");
    ASSERT_TRUE(once && often);
    for (std::size_t i = 0; i < 2; ++i) {
        const Estimate &one = once->variants[0].measures[i].estimate, &many = often->variants[0].measures[i].estimate;
        EXPECT_EQ(often->variants[0].measures[i].count, 200);
        EXPECT_NEAR(many.low, one.low, 0.01);
        EXPECT_NEAR(many.high, one.high, 0.01);
    }
}

}  // namespace
}  // namespace mrose
