#include "experiment/experiment.h"

#include <atomic>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "experiment/results_row.h"
#include "experiment/trial.h"
#include "io/file.h"
#include "io/format.h"
#include "io/toml_text.h"
#include "support/temporary_folder.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using testing::HasSubstr;

constexpr const char* kept = R"(format = "mrose scenario"
version = 1
name = "lane"
environment = "e.toml"
duration_s = 4.0
[[robot]]
name = "a"
type = "r.toml"
start = { x_m = 0.0, y_m = 0.0 }
controller = { kind = "velocity_script", commands = [{ t_s = 0, v_mps = 0.4 }] }
[[object]]
name = "box 1"
kind = "box"
shape = "d.toml"
mass_kg = 5.0
start = { x_m = 0.0, y_m = 5.0 }
[[object]]
name = "box 2"
kind = "box"
shape = "d.toml"
mass_kg = 5.0
start = { x_m = 0.0, y_m = 7.0 }
)";
constexpr const char* robotFile = R"(format = "mrose robot"
version = 1
name = "r"
shape = "d.toml"
mass_kg = 10.0
control_period_s = 0.1
[kinematics]
[motion_noise]
distance_per_distance = 0.05
)";
constexpr const char* shapeFile =
    "format = \"mrose shape\"\nversion = 1\nname = \"d\"\n[[part]]\ncircle = { radius_m = 0.2 }\n";
constexpr const char* placeFile = "format = \"mrose environment\"\nversion = 1\nname = \"e\"\n";
constexpr const char* head = "format = \"mrose experiment\"\nversion = 1\nname = \"lane\"\nscenario = \"s.toml\"\n";

constexpr const char* drawn = R"(trials = 12
[[draw]]
name = "x"
path = "robot[1].start.x_m"
from = -3.0
to = 3.0
[[draw]]
name = "v"
path = "robot[1].controller.commands[1].v_mps"
of = [0.2, 0.4]
)";

/// `text` with another number of trials than 12.
std::string replacedTrials(std::string text, const std::string& trials) {
    return text.replace(text.find("trials = 12"), 11, "trials = " + trials);
}

/// An experiment of files in memory.
class ExperimentTest : public testing::Test {
protected:
    Expected<Experiment> read(const std::string& text) {
        source_ = std::make_unique<KeptDescriptions>(std::map<std::string, std::string>{
            {"s.toml", scenario_}, {"r.toml", robotFile}, {"d.toml", shapeFile}, {"e.toml", placeFile}});
        auto content = parseToml(head + text, "x.toml");
        EXPECT_TRUE(content) << content.error().message();
        if (!content) return tl::unexpected(content.error());
        return readExperiment(
            std::make_shared<const DescriptionFile>(DescriptionFile{"x.toml", "x.toml", std::move(*content)}),
            *source_);
    }
    Experiment experiment(const std::string& text) {
        auto experiment = read(text);
        EXPECT_TRUE(experiment) << experiment.error().message();
        return experiment ? std::move(*experiment) : Experiment{};
    }
    std::string refusal(const std::string& text) {
        const auto experiment = read(text);
        return experiment ? "" : experiment.error().message();
    }
    Expected<ExperimentSummary> run(const Experiment& experiment, const std::string& name = "out") {
        return runExperiment(experiment, options_, folder_.path() / name);
    }
    std::string refusedRun(const std::string& text) {
        const Experiment read = experiment(text);
        const auto summary = run(read, "refused");
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "refused")) << text;
        return summary ? "" : summary.error().message();
    }
    std::string results(const std::string& name = "out") {
        return readFile(folder_.path() / name / "results.csv").value_or("none");
    }
    /// Rows by the names of their columns.
    std::vector<std::map<std::string, std::string>> rows(const std::string& name = "out") {
        std::vector<std::map<std::string, std::string>> all;
        std::vector<std::string> names;
        const std::string text = results(name);
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = text.find('\n', begin);
            const auto cells = resultsCells(std::string_view(text).substr(begin, end - begin));
            begin = end + 1;
            if (names.empty()) {
                names = cells;
                continue;
            }
            for (std::size_t i = 0; i < names.size(); ++i)
                i == 0 ? (void)all.emplace_back() : (void)0, all.back()[names[i]] = cells.at(i);
        }
        return all;
    }
    static double number(const std::string& text) { return std::stod(text); }

    std::string scenario_ = kept;
    TemporaryFolder folder_;
    ExperimentOptions options_;
    std::unique_ptr<KeptDescriptions> source_;
};

TEST_F(ExperimentTest, WhatIsDrawnIsWhereItIsPutAndAmongTheFeatures) {
    const Experiment lane = experiment(std::string(drawn) +
                                       "[features]\nx0 = 'robot[1].x'\nv0 = 'draw.v'\n"
                                       "[measures]\nway = 'robot[1].x - draw.x'\n");
    const auto summary = run(lane);
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_TRUE(summary->complete);
    std::set<std::string> places, speeds;
    for (const auto& row : rows()) {
        EXPECT_EQ(row.at("feature.x0"), row.at("draw.x"));
        EXPECT_EQ(row.at("feature.v0"), row.at("draw.v"));
        EXPECT_LE(std::abs(number(row.at("draw.x"))), 3);
        EXPECT_EQ(row.at("end"), "duration");
        // What it drives in 4 s, but for its noise, of 5 % of what it drives in a period.
        EXPECT_NEAR(number(row.at("measure.way")), 4 * number(row.at("draw.v")), 0.05);
        places.insert(row.at("draw.x"));
        speeds.insert(row.at("draw.v"));
    }
    EXPECT_EQ(places.size(), 12u);
    EXPECT_EQ(speeds, (std::set<std::string>{"0.2", "0.4"}));
}

/// The others are as they would have been.
TEST_F(ExperimentTest, BeginsAtAnyTrial) {
    const std::string measured = "[measures]\nway = 'robot[1].x - draw.x'\n";
    ASSERT_TRUE(run(experiment(drawn + measured), "all"));
    ASSERT_TRUE(run(experiment("first_trial = 9\n" + replacedTrials(drawn + measured, "4")), "last"));
    const auto all = rows("all"), last = rows("last");
    ASSERT_EQ(last.size(), 4u);
    for (std::size_t i = 0; i < last.size(); ++i) EXPECT_EQ(last[i], all[8 + i]) << i;
    EXPECT_EQ(refusal("first_trial = 0\n" + (drawn + measured)),
              "x.toml:5:15: first_trial: expected a whole number from 1 to 10000000");
}

/// One is read as what the other has made of the scenario.
TEST_F(ExperimentTest, VariantMaySetWithinWhatItSets) {
    const std::string set =
        "[[variant]]\nname = \"v\"\nset = { \"robot[1].type.perception\" = { model = \"reference\" }, "
        "\"robot[1].type.perception.error_scale\" = 0.5 }\n";
    const Experiment lane = experiment("trials = 1\n" + set);
    ASSERT_EQ(lane.variants.size(), 1u);
    TrialExpressions expressions(lane);
    const auto trial = TrialMaker(lane, expressions, {}).make(1);
    ASSERT_TRUE(trial) << trial.error().message();
    EXPECT_EQ(trial->scenarios[0].parts.scene.robotTypes[0].perception.errorScale, 0.5);
    EXPECT_THAT(
        refusal("trials = 1\n[[variant]]\nname = \"v\"\nset = { \"robot[1].type.perception.error_scale\" = 1 }\n"),
        HasSubstr("error_scale: is not a known key"));
}

TEST_F(ExperimentTest, RowsAreTheSameForAnyNumberOfThreadsAndResumed) {
    const Experiment lane = experiment("seeds = 3\n" + std::string(drawn) + "[measures]\nway = 'robot[1].x'\n");
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        ASSERT_TRUE(run(lane, "one"));
    }
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 8);
        ASSERT_TRUE(run(lane, "eight"));
    }
    EXPECT_EQ(results("one"), results("eight"));
    // Stopped after some rows, it goes on with the rest, and repeats none.
    int begun = 0;
    std::atomic<std::int64_t> done = 0;
    options_.progress = [&](std::int64_t now, std::int64_t) { done = now; };
    options_.goesOn = [&] { return done < 10; };
    const auto stopped = run(lane, "resumed");
    ASSERT_TRUE(stopped) << stopped.error().message();
    EXPECT_FALSE(stopped->complete);
    EXPECT_GE(stopped->done, 10);
    EXPECT_LT(stopped->done, 36);
    options_.goesOn = {};
    options_.begins = [&](const RunKey&) { ++begun; };
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const auto resumed = run(lane, "resumed");
    ASSERT_TRUE(resumed) << resumed.error().message();
    EXPECT_EQ(resumed->resumed, stopped->done);
    EXPECT_EQ(begun, 36 - stopped->done);
    EXPECT_EQ(results("resumed"), results("one"));
    // More trials later leave the earlier ones as they are.
    Experiment more = lane;
    more.trials = 15;
    const std::string before = results("one");
    ASSERT_TRUE(run(more, "one"));
    EXPECT_EQ(results("one").substr(0, before.size()), before);
    EXPECT_FALSE(run(lane, "one")) << "rows would get lost";
}

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
        "some = 'draw.u < 0.3'\nall = 'time > 0'\nnumber = 'draw.u'\n");
    const auto summary = run(lane);
    ASSERT_TRUE(summary) << summary.error().message();
    const auto& measures = summary->variants[0].measures;
    for (const MeasureSummary& measure : {measures[0], measures[1]}) {
        ASSERT_TRUE(measure.share) << measure.name;
        for (const double end : {measure.low, measure.high})
            if (end < 1) {
                EXPECT_NEAR(std::abs(measure.mean - end), 1.959964 * std::sqrt(end * (1 - end) / 40), 1e-12);
            }
        EXPECT_LT(measure.low, measure.mean);
    }
    EXPECT_GT(measures[0].high, measures[0].mean);
    EXPECT_EQ(measures[1].high, 1);
    EXPECT_FALSE(measures[2].share);
}

TEST_F(ExperimentTest, VariantsOfATrialBeginAlikeAndHaveTheSameNoise) {
    EXPECT_THAT(refusal(std::string(drawn) + "[[variant]]\nname = \"b\"\nset = { \"robot[1].surface\" = 1 }\n"),
                HasSubstr("surface"));
    const Experiment two = experiment(std::string(drawn) + R"([[variant]]
name = "as it is"
[[variant]]
name = "faster"
set = { "robot[1].controller.commands[1].v_mps" = 0.5 }
[measures]
way = 'robot[1].x - draw.x'
)");
    const auto summary = run(two);
    ASSERT_TRUE(summary) << summary.error().message();
    ASSERT_EQ(summary->variants.size(), 2u);
    EXPECT_NEAR(summary->variants[1].measures[0].mean, 2, 0.05);
    const auto all = rows();
    ASSERT_EQ(all.size(), 24u);
    for (std::size_t i = 0; i < all.size(); i += 2) {
        EXPECT_EQ(all[i].at("trial"), all[i + 1].at("trial"));
        EXPECT_EQ(all[i].at("draw.x"), all[i + 1].at("draw.x"));
        // The noise is a share of the way: of the same draws the same share.
        const double share = number(all[i].at("measure.way")) / number(all[i].at("draw.v"));
        EXPECT_NEAR(number(all[i + 1].at("measure.way")) / 0.5, share, 1e-9);
    }
}

TEST_F(ExperimentTest, SomeBodiesAreThereAndOthersNot) {
    const Experiment boxes = experiment(R"(trials = 30
[[draw]]
name = "boxes"
bodies = ["box 1", "box 2"]
[[draw]]
name = "off"
mean = 0.0
deviation = 0.1
least = -0.15
most = 0.15
[[draw]]
name = "ahead"
path = ["object[1].start.x_m", "object[2].start.x_m"]
value = 'draw.off + 1'
[features]
count = '#object'
ahead = '(function() local n = 0 for i = 1, #object do n = n + object[i].x end return n end)()'
)");
    ASSERT_TRUE(run(boxes));
    std::map<std::string, int> counts;
    for (const auto& row : rows()) {
        EXPECT_EQ(row.at("feature.count"), row.at("draw.boxes"));
        EXPECT_LE(std::abs(number(row.at("draw.off"))), 0.15);
        EXPECT_NEAR(number(row.at("draw.ahead")), 1 + number(row.at("draw.off")), 1e-12);
        EXPECT_NEAR(number(row.at("feature.ahead")), number(row.at("draw.boxes")) * number(row.at("draw.ahead")),
                    1e-12);
        ++counts[row.at("draw.boxes")];
    }
    EXPECT_EQ(counts.size(), 3u);
}

TEST_F(ExperimentTest, VariantsMaySetWhatIsOfABodyThatIsLeftOut) {
    const Experiment boxes = experiment(R"(trials = 12
[[draw]]
name = "boxes"
bodies = ["box 1", "box 2"]
[[variant]]
name = "as it is"
[[variant]]
name = "nearer"
set = { "object[1].start.x_m" = 1.25, "object[2].start.x_m" = 1.25 }
[measures]
count = '#object'
x = '(function() local n = 0 for i = 1, #object do n = n + object[i].x end return n end)()'
)");
    ASSERT_TRUE(run(boxes));
    std::map<std::string, int> counts;
    for (const auto& row : rows()) {
        EXPECT_EQ(row.at("measure.count"), row.at("draw.boxes"));
        ++counts[row.at("draw.boxes")];
        if (row.at("variant") == "2") {
            EXPECT_NEAR(number(row.at("measure.x")), 1.25 * number(row.at("draw.boxes")), 0.05);
        }
    }
    EXPECT_EQ(counts.size(), 3u);
}

TEST_F(ExperimentTest, StartsThatOverlapOrAreNotWantedAreDrawnAgain) {
    const Experiment wanted = experiment(R"(trials = 40
require = 'robot[1].x > 0'
[[draw]]
name = "x"
path = "robot[1].start.x_m"
from = -1.0
to = 1.0
[[draw]]
name = "y"
path = "robot[1].start.y_m"
from = 4.5
to = 5.5
)");
    ASSERT_TRUE(run(wanted));
    for (const auto& row : rows()) {
        EXPECT_GT(number(row.at("draw.x")), 0);
        EXPECT_GE(std::hypot(number(row.at("draw.x")), number(row.at("draw.y")) - 5), 0.4 - 2e-4) << "box 1";
    }
    const Experiment never = experiment("trials = 2\nrequire = 'robot[1].x > 5'\n");
    const auto refused = run(never, "never");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), testing::StartsWith("x.toml:6:11: require: in a hundred draws of trial 1"));
}

TEST_F(ExperimentTest, WrongExpressionsAreToldWithTheirPlaceBeforeTheFirstTrial) {
    EXPECT_THAT(refusedRun("trials = 2\nuntil = 'robot[1].sped > 1'\n"),
                testing::StartsWith("x.toml:6:19: until: there is no 'sped'"));
    EXPECT_THAT(refusedRun("trials = 2\n[features]\na = '1'\nbc = 'robot[2].x'\n"),
                testing::StartsWith("x.toml:8:13: features.bc: there is no robot 2"));
    EXPECT_THAT(refusedRun("trials = 2\n[measures]\nm = { most = 'ball.x' }\n"),
                HasSubstr("measures.m.most: there is no ball"));
    EXPECT_THAT(refusedRun("trials = 2\n[measures]\nm = 'draw.z'\n"),
                HasSubstr("x.toml:7:11: measures.m: there is no draw 'z': there is none"));
    EXPECT_THAT(refusedRun("trials = 2\nuntil = '1 + '\n"), testing::StartsWith("x.toml:6:"));
    EXPECT_THAT(refusedRun("trials = 2\nuntil = '1 + 1'\n"), HasSubstr("until: gives the number 2"));
    EXPECT_THAT(refusedRun("trials = 2\nuntil = 'robot[1].controller.stat == 1'\n"),
                HasSubstr("until: there is no 'stat' in 'controller'"));
    // Whatever bodies are there, as of a later trial.
    EXPECT_THAT(refusedRun("trials = 2\n[[draw]]\nname = \"n\"\nbodies = [\"box 2\"]\n[measures]\n"
                           "m = 'object[\"box 2\"].x'\n"),
                HasSubstr("measures.m: there is no object 'box 2'"));
    EXPECT_THAT(refusedRun("trials = 2\n[measures]\nm = { seconds = 'robot[1].speed' }\n"),
                HasSubstr("measures.m.seconds: gives the number 0.0; expected true or false"));
    EXPECT_THAT(refusedRun("trials = 2\n[[draw]]\nname = \"a\"\nvalue = 'draw.b'\n"),
                HasSubstr("draw[\"a\"].value: there is no draw 'b'"));
}

TEST_F(ExperimentTest, WhatIsWrongWithAFileIsOneLine) {
    EXPECT_THAT(refusal(""), HasSubstr("x.toml:1:1: trials: is missing"));
    EXPECT_THAT(refusal("trials = 0\n"), HasSubstr("x.toml:5:10: trials: expected a whole number from 1"));
    EXPECT_THAT(refusal("trials = 1\nuntill = '1'\n"), HasSubstr("untill: is not a known key"));
    EXPECT_THAT(refusal("trials = 1\nevery_s = 0.03\n"), HasSubstr("every_s: expected whole ticks"));
    const auto draw = [&](const std::string& keys) { return refusal("trials = 1\n[[draw]]\nname = \"a\"\n" + keys); };
    EXPECT_THAT(draw(""), HasSubstr("draw[\"a\"].name: says nothing of what is drawn"));
    EXPECT_THAT(draw("from = 1\n"), HasSubstr("draw[\"a\"].to: is missing"));
    EXPECT_THAT(draw("from = 1\nto = 0\n"), HasSubstr("to: is less than `from`"));
    EXPECT_THAT(draw("from = 0.5\nto = 2\nwhole = true\n"), HasSubstr("whole: expected whole numbers"));
    EXPECT_THAT(draw("of = []\n"), HasSubstr("of: expected an array of 1 to 1000"));
    EXPECT_THAT(draw("mean = 0\ndeviation = -1\n"), HasSubstr("deviation: is -1"));
    EXPECT_THAT(draw("mean = 0\ndeviation = 1\nleast = 1\n"), HasSubstr("mean: expected one between"));
    EXPECT_THAT(draw("bodies = [\"box 3\"]\n"), HasSubstr("bodies[1]: is the name of no body"));
    EXPECT_THAT(draw("path = \"robot[3].start.x_m\"\nfrom = 0\nto = 1\n"),
                HasSubstr("robot[3].start.x_m: names nothing"));
    EXPECT_THAT(draw("bodies = [\"box 1\", \"box 1\"]\n"), HasSubstr("bodies[2]: is there twice"));
    EXPECT_THAT(draw("path = \"seed\"\nfrom = 0\nto = 1\n"), HasSubstr("path: \"seed\" is not for draws"));
    EXPECT_THAT(draw("path = []\nfrom = 0\nto = 1\n"), HasSubstr("path: expected at least one"));
    EXPECT_THAT(
        draw("path = \"seed_\"\nfrom = 0\nto = 1\n[[draw]]\nname = \"b\"\npath = \"seed_\"\nfrom = 0\nto = 1\n"),
        HasSubstr("draw[\"b\"].path: seed_ is that of another draw, too"));
    EXPECT_THAT(refusal("trials = 1\n[[draw]]\nname = \"end\"\nfrom = 0\nto = 1\n"), HasSubstr("is a word of Lua"));
    EXPECT_THAT(refusal("trials = 1\nevery_s = 5.0\n"), HasSubstr("every_s: is longer than a run"));
    EXPECT_THAT(refusal("trials = 1\n[set]\n\"robot[1].sped\" = 1\n"), HasSubstr("x.toml:7:19: set.robot[1].sped: "));
    EXPECT_THAT(refusal("trials = 1\n[[variant]]\nname = \"v\"\nset = { seed = 3 }\n"),
                HasSubstr("set.seed: is a key of the experiment itself"));
    EXPECT_THAT(draw("path = \"robot[1].type\"\nof = [\"none.toml\"]\n"), HasSubstr("\"none.toml\" was not found"));
    EXPECT_THAT(draw("from = 0\nto = 1\n[[draw]]\nname = \"a\"\nfrom = 0\nto = 1\n"),
                HasSubstr("is the name of another draw"));
    EXPECT_THAT(refusal("trials = 1\n[measures]\nm = { most = '1', least = '2' }\n"),
                HasSubstr("m: expected one of `least`"));
    EXPECT_THAT(refusal("trials = 1\n[measures]\n\"m x\" = '1'\n"), HasSubstr("expected a name"));
    // What a draw makes of the scenario is told with the trial that drew it.
    const Experiment misspelt =
        experiment("trials = 1\n[[draw]]\nname = \"a\"\npath = \"robot[1].start.z_m\"\nfrom = 0\nto = 1\n");
    const auto refused = run(misspelt, "misspelt");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), testing::StartsWith("x.toml:7:8: draw[\"a\"]: "));
    EXPECT_THAT(refused.error().message(), HasSubstr("z_m: is not a known key"));
    EXPECT_THAT(refused.error().message(), HasSubstr("(trial 1)"));
}

TEST_F(ExperimentTest, WhatIsSetHoldsForAllTrials) {
    const Experiment lane = experiment(
        "trials = 2\n[set]\n\"robot[1].controller.commands[1].v_mps\" = 0.1\n"
        "\"robot[1].type.motion_noise\" = { }\n[measures]\nway = 'robot[1].x'\n");
    ASSERT_TRUE(run(lane));
    for (const auto& row : rows()) EXPECT_NEAR(number(row.at("measure.way")), 0.4, 1e-9);
}

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
    for (const auto& row : rows()) {
        if (row.at("variant") != "1" || row.at("seed") != "1") continue;
        TrialExpressions expressions(whole);
        auto trial = TrialMaker(whole, expressions, {}).make(static_cast<std::uint32_t>(number(row.at("trial"))));
        ASSERT_TRUE(trial);
        const Scenario scenario(std::move(trial->scenarios[0].parts));
        RunOptions options;
        options.duration = fromSeconds(number(row.at("time_s")));
        const auto result = mrose::run(scenario, scenario.initialState(), options);
        ASSERT_TRUE(result);
        EXPECT_EQ(hexadecimal(hashOf(result->state).world), row.at("world_hash"));
    }
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

TEST_F(ExperimentTest, ResultsOfABatchAreNotReplaced) {
    ASSERT_TRUE(writeFileAtomically(folder_.path() / "batch.txt", "mrose = 1\n"));
    for (const std::string name : {"results.csv", "results.part.csv"}) {
        const std::string rows =
            (name == "results.csv" ? "trial,seed,end,time_s\n" : std::string()) + "1,1,duration,4.0\n";
        ASSERT_TRUE(writeFileAtomically(folder_.path() / name, rows));
        const auto refused = run(experiment("trials = 1\n"), ".");
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message(), HasSubstr("holds results of a batch; expected an empty folder"));
        EXPECT_EQ(readFile(folder_.path() / name).value_or(""), rows);
        std::filesystem::remove(folder_.path() / name);
    }
}

TEST_F(ExperimentTest, FolderOfAnotherExperimentIsRefused) {
    Experiment lane = experiment(drawn);
    options_.identity = {{"content of the experiment", "1"}};
    ASSERT_TRUE(run(lane));
    options_.identity = {{"content of the experiment", "2"}};
    const auto other = run(lane);
    ASSERT_FALSE(other);
    EXPECT_THAT(other.error().message(), HasSubstr("holds other results: the content of the experiment has changed"));
}

}  // namespace
}  // namespace mrose
