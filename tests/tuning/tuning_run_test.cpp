#include "tuning/tuning_run.h"

#include <atomic>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "experiment/results_table.h"
#include "io/file.h"
#include "scenario/settings_file.h"
#include "support/temporary_folder.h"
#include "support/workshop.h"
#include "tuning/lane.h"
#include "tuning/tuning_output.h"

namespace mrose {
namespace {

using testing::HasSubstr;

class TuningRunTest : public testing::Test {
protected:
    Tuning tuning(const std::string& text = std::string(Lane::budget) + Lane::speed) {
        const Value::File file = lane_.file("t.toml", Lane::head + text);
        auto tuning = readTuning(file, lane_.source());
        EXPECT_TRUE(tuning) << tuning.error().message();
        return tuning ? std::move(*tuning) : Tuning{};
    }
    Expected<TuningSummary> run(const Tuning& tuning, const std::string& name = "out") {
        return runTuning(tuning, options_, folder_.path() / name);
    }
    std::string results(const std::string& name = "out") {
        return readFile(folder_.path() / name / "results.csv").value_or("none");
    }

    Lane lane_;
    TemporaryFolder folder_;
    TuningOptions options_;
};

TEST_F(TuningRunTest, FindsTheSpeedThatEndsWhereItIsToEnd) {
    const Tuning lane = tuning();
    const auto summary = run(lane);
    ASSERT_TRUE(summary) << summary.error().message();
    const TunerResult& result = summary->result;
    ASSERT_TRUE(result.complete);
    EXPECT_NEAR(result.candidates[result.best].values[0], 0.25, 0.01) << "1 m in 4 s, from 0 m in the mean";
    const TuningEvidence evidence = evidenceOf(result);
    // 0.6 m too far with 0.4 m/s; with the best one the start's spread is left: 0.05 m in the mean.
    EXPECT_NEAR(evidence.before.mean, 0.6, 0.05);
    EXPECT_NEAR(evidence.after.mean, 0.05, 0.02);
    EXPECT_NEAR(evidence.change.mean, evidence.after.mean - evidence.before.mean, 1e-12);
    EXPECT_LT(evidence.change.high, 0);
}

TEST_F(TuningRunTest, RowsAreThoseOfTheCandidatesWithTheSameDrawsAndSeeds) {
    const Tuning lane = tuning();
    const auto summary = run(lane);
    ASSERT_TRUE(summary);
    const auto table = readResultsTable(folder_.path() / "out");
    ASSERT_TRUE(table) << table.error().message();
    EXPECT_EQ(std::ssize(table->rows), summary->runs);
    const std::size_t x = table->columnOf("draw.x"), off = table->columnOf("measure.off"),
                      command = table->columnOf("command");
    std::map<std::string, std::string> drawn;
    std::map<std::size_t, std::map<std::string, double>> costs;  // by candidate and trial
    for (std::size_t i = 0; i < table->rows.size(); ++i) {
        const std::vector<std::string>& row = table->rows[i];
        EXPECT_EQ(drawn.emplace(row[0], row[x]).first->second, row[x]) << "of one trial";
        costs[std::stoul(row[2]) - 1][row[0]] += table->number(i, off) / 2;  // two seeds
        EXPECT_EQ(row[3], "candidate " + row[2]);
        EXPECT_EQ((std::stoul(row[1]) + 1) / 2, std::stoul(row[0])) << "the trial's seeds, whatever the candidate";
        EXPECT_THAT(row[command], HasSubstr("--set 'robot[1].controller.commands[1].v_mps="));
        EXPECT_THAT(row[command], HasSubstr(" --trial " + row[0] + " --seed " + row[1]));
    }
    const Candidate& best = summary->result.candidates[summary->result.best];
    double mean = 0;
    for (int trial = 1; trial <= 16; ++trial) mean += costs[summary->result.best].at(std::to_string(trial)) / 16;
    EXPECT_NEAR(best.cost, mean, 1e-12);
    for (const Candidate& candidate : summary->result.candidates)
        EXPECT_GE(candidate.cost, candidate.dropped ? best.cost : mean);
}

TEST_F(TuningRunTest, IsTheSameForAnyNumberOfThreads) {
    const Tuning lane = tuning();
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        ASSERT_TRUE(run(lane, "one"));
    }
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 8);
        ASSERT_TRUE(run(lane, "eight"));
    }
    EXPECT_EQ(results("one"), results("eight"));
    EXPECT_NE(results("one"), "none");
}

TEST_F(TuningRunTest, GoesOnAsIfItHadNotBeenInterrupted) {
    const Tuning lane = tuning();
    const auto whole = run(lane, "whole");
    ASSERT_TRUE(whole);
    std::atomic<int> begun{0};
    std::int64_t before = 0;
    int interruptions = 0;
    for (bool complete = false; !complete; ++interruptions) {
        ASSERT_LT(interruptions, 50);
        begun = 0;
        options_.begins = [&](const RunKey&) { ++begun; };
        options_.goesOn = [&] { return begun <= 150; };
        const auto part = run(lane, "parts");
        ASSERT_TRUE(part) << part.error().message();
        EXPECT_EQ(part->resumed, before) << "nothing finished is lost";
        EXPECT_LE(begun, 160);
        before = part->runs;
        complete = part->result.complete;
        if (!complete) continue;
        EXPECT_EQ(part->runs, whole->runs);
        EXPECT_EQ(candidatesText(lane, part->result), candidatesText(lane, whole->result));
        EXPECT_EQ(settingsText(lane, part->result, {}), settingsText(lane, whole->result, {}));
    }
    EXPECT_GT(interruptions, 2);
    EXPECT_EQ(results("parts"), results("whole"));
}

TEST_F(TuningRunTest, InterruptedWhileItsDrivingIsWatchedItIsNotComplete) {
    const Tuning lane = tuning();
    std::atomic<int> begun{0};
    options_.begins = [&](const RunKey&) { ++begun; };
    const auto whole = run(lane, "whole");
    ASSERT_TRUE(whole);
    const int all = begun.exchange(0);
    ASSERT_EQ(all, whole->runs + 20) << "the trials held out once more, as what is now";
    options_.goesOn = [&] { return begun <= all - 10; };
    const auto part = run(lane, "parts");
    ASSERT_TRUE(part);
    EXPECT_FALSE(part->result.complete);
    EXPECT_EQ(part->runs, whole->runs);
    EXPECT_EQ(results("parts"), "none");
    options_.goesOn = {};
    const auto rest = run(lane, "parts");
    ASSERT_TRUE(rest);
    EXPECT_TRUE(rest->result.complete);
    EXPECT_EQ(rest->resumed, whole->runs);
    EXPECT_EQ(results("parts"), results("whole"));
}

TEST_F(TuningRunTest, MoreEvaluationsGoOnAndFewerAreRefused) {
    Tuning lane = tuning();
    const auto first = run(lane);
    ASSERT_TRUE(first);
    lane.options.evaluations = 400;
    const auto more = run(lane);
    ASSERT_TRUE(more) << more.error().message();
    EXPECT_EQ(more->resumed, first->runs);
    EXPECT_GT(more->runs, first->runs);
    lane.options.evaluations = 100;
    const auto fewer = run(lane);
    ASSERT_FALSE(fewer);
    EXPECT_THAT(fewer.error().message(), HasSubstr("holds more evaluations than are asked for now"));
}

TEST_F(TuningRunTest, AFolderOfAnotherTuningIsRefused) {
    const Tuning lane = tuning();
    options_.identity["content of the tuning"] = "1";
    ASSERT_TRUE(run(lane));
    options_.identity["content of the tuning"] = "2";
    const auto other = run(lane);
    ASSERT_FALSE(other);
    EXPECT_THAT(other.error().message(), HasSubstr("the content of the tuning has changed"));
}

TEST_F(TuningRunTest, ARunWithoutANumberCostsWhatTheFileSays) {
    const std::string never = "trials = 16\nheld_out = 20\nevaluations = 60\ncost = \"never\"\n";
    const auto refused = run(tuning(never + Lane::speed), "refused");
    ASSERT_FALSE(refused);
    EXPECT_EQ(
        refused.error().message(),
        "t.toml:8:8: cost: is no number in trial 1 of candidate 1; expected `failure_cost`, what such a run costs");
    const auto failing = run(tuning(never + "failure_cost = 3.5\n" + Lane::speed), "failing");
    ASSERT_TRUE(failing) << failing.error().message();
    EXPECT_EQ(failing->result.candidates[0].costs, std::vector<double>(16, 3.5));
    EXPECT_EQ(failing->result.best, 0u);
}

TEST_F(TuningRunTest, WrongExpressionsAreToldBeforeTheFolderIsMade) {
    std::string& experiment = lane_.texts["x.toml"];
    experiment.replace(experiment.find("robot[1].x > 100"), 16, "robot[9].x > 100");
    const auto refused = run(tuning(), "refused");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), HasSubstr("x.toml:14:"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "refused"));
}

TEST_F(TuningRunTest, TheSettingsAreReadAndGiveTheScenarioThatWasFound) {
    const Tuning lane = tuning();
    const auto summary = run(lane);
    ASSERT_TRUE(summary);
    const auto content = parseToml(settingsText(lane, summary->result, {{"command", "mrose tune"}}), "tuned.toml");
    ASSERT_TRUE(content) << content.error().message();
    const auto settings = readSettings(*content, "tuned.toml");
    ASSERT_TRUE(settings) << settings.error().message();
    const auto with = settings->putInto(lane.experiment.scenario);
    ASSERT_TRUE(with);
    EXPECT_EQ(*with->at("robot[1].controller.commands[1].v_mps")->asFloat(),
              summary->result.candidates[summary->result.best].values[0]);
    EXPECT_EQ(*content->at("evidence.held_out_from")->asInteger(), 17);
    EXPECT_EQ(*content->at("evidence.after.mean")->asFloat(), evidenceOf(summary->result).after.mean);
}

/// Of a robot that is named and of all: it is judged as the settings then are.
TEST_F(TuningRunTest, AParameterOfOneRobotPrevailsOverOneOfAll) {
    std::string& scenario = lane_.texts["s.toml"];
    scenario +=
        replaced(replaced(scenario.substr(scenario.find("[[robot]]")), "\"a\"", "\"b\""), "y_m = 0.0", "y_m = 3.0");
    const std::string ofAll = replaced(Lane::speed, "robot[1]", "robot[*]"),
                      ofOne =
                          replaced(replaced(Lane::speed, "robot[1]", "robot[\\\"a\\\"]"), "\"speed\"", "\"its speed\"");
    const Tuning lanes = tuning(Lane::budget + ofOne + ofAll);
    const auto summary = run(lanes);
    ASSERT_TRUE(summary) << summary.error().message();
    const std::vector<double>& found = summary->result.candidates[summary->result.best].values;
    EXPECT_NEAR(found[0], 0.25, 0.02) << "the one whose way is measured";
    EXPECT_NE(found[0], found[1]);
    const auto content = parseToml(settingsText(lanes, summary->result, {}), "tuned.toml");
    ASSERT_TRUE(content) << content.error().message();
    const auto with = readSettings(*content, "tuned.toml")->putInto(lanes.experiment.scenario);
    ASSERT_TRUE(with);
    EXPECT_EQ(*with->at("robot[1].controller.commands[1].v_mps")->asFloat(), found[0]);
    EXPECT_EQ(*with->at("robot[2].controller.commands[1].v_mps")->asFloat(), found[1]);
    // Also where a variant names them.
    lane_.texts["tuned.toml"] = settingsText(lanes, summary->result, {});
    const Value::File file = lane_.file(
        "y.toml", std::string(Lane::experiment) + "[[variant]]\nname = \"tuned\"\nsettings = \"tuned.toml\"\n");
    const auto experiment = readExperiment(file, lane_.source());
    ASSERT_TRUE(experiment) << experiment.error().message();
    ASSERT_EQ(experiment->variants[0].set.size(), 2u);
    EXPECT_EQ(experiment->variants[0].set[0].second, Value(found[1]));
    EXPECT_EQ(experiment->variants[0].set[1].second, Value(found[0]));
}

/// Of an experiment whose variant names settings.
class VariantSettingsTest : public testing::Test {
protected:
    Expected<Experiment> read(const std::string& settings) {
        lane_.texts["tuned.toml"] = settings;
        const Value::File file = lane_.file("y.toml", std::string(Lane::experiment) +
                                                          "[[variant]]\nname = \"before\"\n[[variant]]\nname = "
                                                          "\"tuned\"\nsettings = \"tuned.toml\"\n"
                                                          "set = { \"robot[1].start.y_m\" = 1.0 }\n");
        return readExperiment(file, lane_.source());
    }
    std::string refusal(const std::string& set) {
        const auto experiment = read("format = \"mrose settings\"\nversion = 1\n[set]\n" + set);
        return experiment ? "" : experiment.error().message();
    }
    Lane lane_;
};

TEST_F(VariantSettingsTest, AreSetBeforeWhatTheVariantSets) {
    const auto experiment = read(
        "format = \"mrose settings\"\nversion = 1\n[set]\n\"robot[1].controller.commands[1].v_mps\" = 0.25\n"
        "\"robot[1].start.y_m\" = 2.0\n[evidence]\nanything = \"goes\"\n");
    ASSERT_TRUE(experiment) << experiment.error().message();
    EXPECT_TRUE(experiment->variants[0].set.empty());
    const auto& set = experiment->variants[1].set;
    ASSERT_EQ(set.size(), 3u);
    EXPECT_EQ(set[0].first, "robot[1].controller.commands[1].v_mps");
    EXPECT_EQ(set[0].second, Value(0.25));
    EXPECT_EQ(set[2].second, Value(1.0));
    EXPECT_EQ(experiment->settings.size(), 1u);
}

TEST_F(VariantSettingsTest, ThatDoNotFitAreNamedByTheirOwnLine) {
    EXPECT_THAT(refusal("\"robot[7].start.x_m\" = 1.0\n"),
                HasSubstr("tuned.toml:4:24: robot[7].start.x_m: names nothing that there is"));
    EXPECT_THAT(refusal("\"robot[1].controller.sped\" = 1.0\n"),
                HasSubstr("tuned.toml:4:30: robot[1].controller.sped: "));
    EXPECT_THAT(refusal("\"robot[1].controller.sped\" = 1.0\n"), HasSubstr("is not a known key"));
    EXPECT_THAT(refusal("\"robot[1].controller.commands[1].v_mps\" = \"fast\"\n"), HasSubstr("tuned.toml:4:43: "));
    EXPECT_THAT(refusal("seed = 1\n"), HasSubstr("tuned.toml:4:8: set.seed: is nothing that settings may set"));
    EXPECT_THAT(refusal(""), HasSubstr("tuned.toml:3:1: set: expected at least one path"));
    EXPECT_THAT(refusal("\"robot[1].start.y_m\" = 1.0\n[more]\n"), HasSubstr("tuned.toml:5:"));
    lane_.texts.erase("tuned.toml");
}

}  // namespace
}  // namespace mrose
