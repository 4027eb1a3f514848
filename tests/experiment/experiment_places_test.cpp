// Where an experiment puts what it draws and sets, and how it calls what is wrong.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiment/experiment_fixture.h"
#include "experiment/trial.h"

namespace mrose {
namespace {

using namespace experiment_test;
using testing::HasSubstr;

/// In whatever order they are drawn, and a whole comes before its parts.
TEST_F(ExperimentTest, WhatIsDrawnOfOneBodyPrevailsOverWhatIsDrawnOfAll) {
    const auto draw = [](const std::string& name, const std::string& path, const std::string& rest) {
        return "[[draw]]\nname = \"" + name + "\"\npath = '" + path + "'\n" + rest + '\n';
    };
    const std::string light = "from = 1\nto = 2", heavy = "from = 50\nto = 60";
    const std::string one = draw("one", "object[\"box 1\"].mass_kg", light),
                      all = draw("all", "object[*].mass_kg", heavy);
    const std::string x = draw("x", "object[\"box 2\"].start.x_m", light);
    const std::string start = draw("start", "object[2].start", "of = [{ x_m = 9.0, y_m = 9.0 }]");
    for (const std::string& draws : {one + all + x + start, all + one + start + x}) {
        const Experiment lane = experiment("trials = 1\n" + draws);
        TrialExpressions expressions(lane);
        const auto trial = TrialMaker(lane, expressions, {}).make(1);
        ASSERT_TRUE(trial) << trial.error().message();
        const Scene& scene = trial->scenarios[0].parts.scene;
        const auto drawnAs = [&](const std::string& name) {
            return *std::ranges::find(trial->drawn, name, &DrawnValue::name)->value.asFloat();
        };
        EXPECT_EQ(scene.typeOfObject(0).mass, drawnAs("one"));
        EXPECT_EQ(scene.typeOfObject(1).mass, drawnAs("all"));
        EXPECT_EQ(scene.objects[1].start.x, drawnAs("x"));
        EXPECT_EQ(scene.objects[1].start.y, 9);
    }
    const std::string two = draw("two", "object[2].mass_kg", light);
    EXPECT_THAT(refusal("trials = 1\n" + one + all + two),
                HasSubstr("x.toml:12:8: draw[\"all\"]: object[*].mass_kg has no effect: other draws set each of its "
                          "elements"));
    EXPECT_THAT(refusal("trials = 1\n" + one + draw("same", "object[1].mass_kg", heavy)),
                HasSubstr("draw[\"same\"].path: object[1].mass_kg is that of another draw, too"));
}

/// Alone the type's period is no whole number of the scenario's ticks; the file that it names is found all the same.
TEST_F(ExperimentTest, SettingsThatFitTogetherAloneHoldTheirFiles) {
    more_ = {{"w.toml",
              "format = \"mrose settings\"\nversion = 1\n[set]\n\"robot[1].type\" = \"q.toml\"\n"
              "tick_s = 0.005\n"},
             {"q.toml", std::string(robotFile).replace(std::string(robotFile).find("0.1\n"), 3, "0.025")}};
    const Experiment lane = experiment("trials = 1\n[[variant]]\nname = \"v\"\nsettings = \"w.toml\"\n");
    TrialExpressions expressions(lane);
    const auto trial = TrialMaker(lane, expressions, {}).make(1);
    ASSERT_TRUE(trial) << trial.error().message();
    EXPECT_EQ(trial->scenarios[0].parts.scene.modelOf(0).period(), fromSeconds(0.025));
}

TEST_F(ExperimentTest, FirstFaultOfAnExpressionNamesItsTrial) {
    const auto summary =
        run(experiment("trials = 12\n[[draw]]\nname = \"x\"\nfrom = -1\nto = 1\n"
                       "[measures]\nm = 'time > 0 and draw.x > 0 and \"a\" or 1'\n"));
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_THAT(summary->variants[0].firstFault,
                testing::MatchesRegex("x.toml:11:[0-9]+: measures.m: [^()]* \\(trial [0-9]+\\)"));
}

}  // namespace
}  // namespace mrose
