#include "experiment/experiment.h"

#include <array>
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

TEST_F(ExperimentTest, ASweepIsAVariantForEachValue) {
    const Experiment lane = experiment(std::string(drawn) + R"([[variant]]
name = "as it is"
[[sweep]]
name = "pace"
unit = "%"
values = [50, 100.5, 150]
set = { "robot[1].controller.commands[1].w_degps" = 9 }
scaled = { "robot[1].controller.commands[1].v_mps" = 0.004 }
[measures]
commanded = 'robot[1].command_v'
turned = 'robot[1].command_w'
)");
    const auto summary = run(lane);
    ASSERT_TRUE(summary) << summary.error().message();
    ASSERT_EQ(summary->variants.size(), 4u);
    EXPECT_FALSE(summary->variants[0].sweep);
    for (std::size_t i = 1; i < 4; ++i) {
        const VariantSummary& variant = summary->variants[i];
        EXPECT_EQ(variant.name, (std::array{"", "pace 50 %", "pace 100.5 %", "pace 150 %"})[i]);
        ASSERT_TRUE(variant.sweep);
        EXPECT_EQ(variant.sweep->name, "pace");
        EXPECT_EQ(variant.sweep->unit, "%");
        EXPECT_EQ(variant.sweep->at, (std::array{0.0, 50.0, 100.5, 150.0})[i]);
        EXPECT_NEAR(variant.measures[0].mean, 0.004 * variant.sweep->at, 1e-12);
        EXPECT_NEAR(variant.measures[1].mean, std::numbers::pi / 20, 1e-12);
    }
    std::map<std::string, std::set<std::string>> swept;
    for (const auto& row : rows()) swept[row.at("variant_name")].insert(row.at("swept"));
    EXPECT_EQ(swept,
              (std::map<std::string, std::set<std::string>>{
                  {"as it is", {""}}, {"pace 50 %", {"50"}}, {"pace 100.5 %", {"100.5"}}, {"pace 150 %", {"150"}}}));
}

TEST_F(ExperimentTest, WhatIsSweptMayBeAWholeNumberAndIsNamedAsPeopleWriteIt) {
    const Experiment lane = experiment(std::string(drawn) + R"([[sweep]]
name = "ticks"
values = [-0.0, 100000, 0.001]
scaled = { "robot[1].controller.commands[1].t_s" = 0.00001 }
[[sweep]]
name = "bytes"
values = [64, 128]
scaled = { "radio.message_bytes" = 1 }
)");
    std::vector<std::string> names;
    for (const Variant& variant : lane.variants) names.push_back(variant.name);
    EXPECT_EQ(names, (std::vector<std::string>{"ticks 0", "ticks 100000", "ticks 0.001", "bytes 64", "bytes 128"}));
}

TEST_F(ExperimentTest, SweepsThatAreWrongNameThePlace) {
    const auto sweep = [&](const std::string& rest) {
        return refusal("trials = 1\n[[sweep]]\nname = \"pace\"\n" + rest);
    };
    const std::string scaled = "scaled = { \"robot[1].controller.commands[1].v_mps\" = 0.01 }\n";
    EXPECT_THAT(sweep(scaled), HasSubstr("sweep[\"pace\"].values: is missing"));
    EXPECT_THAT(sweep("values = [1]\n" + scaled), HasSubstr("x.toml:8:10: sweep[\"pace\"].values: expected"));
    EXPECT_THAT(sweep("values = [1, \"two\"]\n" + scaled),
                HasSubstr("x.toml:8:14: sweep[\"pace\"].values: expected a finite number"));
    EXPECT_THAT(sweep("values = [1, 2, 1]\n" + scaled), HasSubstr("\"pace 1\" is the name of another variant, too"));
    EXPECT_THAT(sweep("values = [1, 2]\n"), HasSubstr("sweep[\"pace\"].scaled: is missing"));
    EXPECT_THAT(sweep("unit = \"a\\nb\"\nvalues = [1, 2]\n" + scaled), HasSubstr("x.toml:8:8: sweep[\"pace\"].unit: "));
    EXPECT_THAT(sweep("unit = \"quintillions of them\"\nvalues = [1, 2]\n" + scaled), HasSubstr("unit: is too long"));
    EXPECT_THAT(sweep("values = [1, 2]\n" + scaled + "[[sweep]]\nname = \"pace\"\nvalues = [3, 4]\n" + scaled),
                HasSubstr("x.toml:11:8: sweep[\"pace\"].name: is the name of another sweep, too"));
    EXPECT_THAT(sweep("values = [1, 100000]\nscaled = { \"robot[1].type.mass_kg\" = 10 }\n"),
                HasSubstr("x.toml:8:14: sweep[\"pace\"].values[2]: "))
        << "which value is too large";
    EXPECT_THAT(sweep("values = [1, 2]\nscaled = {}\n"), HasSubstr("expected at least one place and its factor"));
    EXPECT_THAT(sweep("values = [1, 2]\nscaled = { \"robot[1].surface\" = 1 }\n"), HasSubstr("is not a known key"));
    EXPECT_THAT(sweep("values = [1, 2]\nscaled = { \"robot[1].name\" = 1 }\n"), HasSubstr("expected a text"));
    EXPECT_THAT(sweep("values = [1, 2]\nscaled = { seed = 1 }\n"), HasSubstr("is a key of the experiment itself"));
    EXPECT_THAT(sweep("values = [1, 2]\nscaled = { \"robot[1].controller.commands[1].v_mps\" = \"x\" }\n"),
                HasSubstr("expected a finite number"));
    EXPECT_THAT(sweep("values = [1, 2]\nsteps = 3\n" + scaled), HasSubstr("steps"));
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
    std::set<double> shares;
    for (std::size_t i = 0; i < all.size(); i += 2) {
        EXPECT_EQ(all[i].at("trial"), all[i + 1].at("trial"));
        EXPECT_EQ(all[i].at("draw.x"), all[i + 1].at("draw.x"));
        // The noise is a share of the way: of the same draws the same share.
        const double share = number(all[i].at("measure.way")) / number(all[i].at("draw.v"));
        EXPECT_NEAR(number(all[i + 1].at("measure.way")) / 0.5, share, 1e-9);
        shares.insert(share);
    }
    EXPECT_EQ(shares.size(), 12u) << "other trials have other noise";
}

TEST_F(ExperimentTest, EveryRunOfATrialHasASeedOfItsOwn) {
    ASSERT_TRUE(run(experiment("seed = 5\nseeds = 3\n" + std::string(drawn) +
                               "[[variant]]\nname = \"a\"\n[[variant]]\nname = \"b\"\n")));
    std::map<std::string, std::set<std::string>> seeds;
    for (const auto& row : rows()) seeds[row.at("variant")].insert(row.at("seed"));
    EXPECT_EQ(seeds["1"].size(), 36u);
    EXPECT_EQ(*std::ranges::min_element(seeds["1"], {}, [](const std::string& seed) { return number(seed); }), "5");
    EXPECT_EQ(seeds["1"], seeds["2"]);
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
    EXPECT_THAT(refused.error().message(), testing::StartsWith("x.toml:6:11: require: in a hundred draws bodies"));
    EXPECT_THAT(refused.error().message(), testing::EndsWith(" (trial 1)"));
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
    // Also what it makes of a file that the scenario names, and before any trial what only few trials would draw.
    const auto drawing = [&](const std::string& keys) {
        const auto summary = run(experiment("trials = 1\n[[draw]]\nname = \"a\"\n" + keys), "drawing");
        return summary ? "" : summary.error().message();
    };
    EXPECT_THAT(drawing("path = \"robot[1].type.mass\"\nfrom = 1\nto = 2\n"),
                testing::StartsWith("x.toml:7:8: draw[\"a\"]: mass: is not a known key"));
    const std::string far = drawing("path = \"robot[1].type.mass_kg\"\nfrom = 1\nto = 100001\n");
    EXPECT_THAT(far, testing::StartsWith("x.toml:7:8: draw[\"a\"]: mass_kg: is 100001.0; expected"));
    EXPECT_THAT(far, HasSubstr("(as it may be drawn)"));
}

/// Ends of draws are tried as trials would have them: with what is computed of them, and with what variants set.
TEST_F(ExperimentTest, EndsOfDrawsAreTriedAsTrialsHaveThem) {
    const Experiment ordered = experiment(
        "trials = 3\n[set]\n\"robot[1].controller.commands\" = [{ t_s = 0, v_mps = 0.4 }, { t_s = 9, v_mps = 0 }]\n"
        "[[draw]]\nname = \"t\"\npath = \"robot[1].controller.commands[1].t_s\"\nfrom = 0\nto = 2\n"
        "[[draw]]\nname = \"u\"\npath = \"robot[1].controller.commands[2].t_s\"\nvalue = 'draw.t + 0.5'\n");
    const auto inOrder = run(ordered, "ordered");
    EXPECT_TRUE(inOrder) << inOrder.error().message();
    const std::string mass =
        "trials = 3\n[[draw]]\nname = \"m\"\npath = \"robot[1].type.mass_kg\"\nfrom = -2\nto = 9\n";
    const auto replaced =
        run(experiment(mass + "[[variant]]\nname = \"v\"\nset = { \"robot[1].type.mass_kg\" = 5 }\n"), "replaced");
    EXPECT_TRUE(replaced) << replaced.error().message();
    const auto refused =
        run(experiment(mass + "[[variant]]\nname = \"v\"\nset = { \"object[1].mass_kg\" = 5 }\n"), "refused");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), testing::StartsWith("x.toml:7:8: draw[\"m\"]: mass_kg: is -"));
}

/// Two bodies of one file: the error of the file does not say of which.
TEST_F(ExperimentTest, OfTwoDrawsTheOneIsToldThatMakesTheMistake) {
    const auto refused = run(
        experiment("trials = 3\n[[draw]]\nname = \"one\"\npath = \"object[1].shape.part[1].circle.radius_m\"\nfrom = "
                   "0.1\nto = 0.2\n[[draw]]\nname = \"two\"\npath = "
                   "\"object[2].shape.part[1].circle.radius_m\"\nfrom = -1\nto = 0.2\n"),
        "two");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), testing::StartsWith("x.toml:12:8: draw[\"two\"]: "));
}

TEST_F(ExperimentTest, WhatIsSetHoldsForAllTrials) {
    const Experiment lane = experiment(
        "trials = 2\n[set]\n\"robot[1].controller.commands[1].v_mps\" = 0.1\n"
        "\"robot[1].type.motion_noise\" = { }\n[measures]\nway = 'robot[1].x'\n");
    ASSERT_TRUE(run(lane));
    for (const auto& row : rows()) EXPECT_NEAR(number(row.at("measure.way")), 0.4, 1e-9);
}

TEST_F(ExperimentTest, WhatIsSetOfOneBodyPrevailsOverWhatIsSetOfAll) {
    const std::string one = "'object[\"box 1\"].mass_kg' = 7.0\n", all = "'object[*].mass_kg' = 9.0\n";
    const Experiment lane = experiment(
        "trials = 1\n[set]\n" + one + all + "[[variant]]\nname = \"as set\"\n[[variant]]\nname = \"heavy\"\n" +
        "[variant.set]\n'object[\"box 2\"].mass_kg' = 70.0\n'object[*].mass_kg' = 90.0\n");
    TrialExpressions expressions(lane);
    const auto trial = TrialMaker(lane, expressions, {}).make(1);
    ASSERT_TRUE(trial) << trial.error().message();
    const auto mass = [&](std::size_t variant, std::size_t box) {
        return trial->scenarios[variant].parts.scene.typeOfObject(box).mass;
    };
    EXPECT_EQ(mass(0, 0), 7);
    EXPECT_EQ(mass(0, 1), 9);
    EXPECT_EQ(mass(1, 0), 90);
    EXPECT_EQ(mass(1, 1), 70);
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
