#include "tuning/tuning_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tuning/lane.h"

namespace mrose {
namespace {

using testing::HasSubstr;

class TuningFileTest : public testing::Test {
protected:
    Expected<Tuning> read(const std::string& text) {
        const Value::File file = lane_.file("t.toml", Lane::head + text);
        return readTuning(file, lane_.source());
    }
    std::string refusal(const std::string& text) {
        const auto tuning = read(text);
        return tuning ? "" : tuning.error().message();
    }
    /// Of the whole with a line more in its parameter, or another one.
    std::string refusalOf(const std::string& line, const std::string& instead = "") {
        std::string text = std::string(Lane::budget) + Lane::speed;
        if (instead.empty()) return refusal(text + line + '\n');
        text.replace(text.find(instead), instead.size(), line);
        return refusal(text);
    }

    Lane lane_;
};

TEST_F(TuningFileTest, SaysWhatIsSearchedAndForWhatCost) {
    const auto tuning = read(
        "trials = 16\nheld_out = 20\nevaluations = 300\ncost = { off = 2.0, never = -0.5 }\n"
        "seed = 9\nracing = false\nfailure_cost = 7.0\n" +
        std::string(Lane::speed) + "scale = \"log\"\n");
    ASSERT_TRUE(tuning) << tuning.error().message();
    EXPECT_EQ(tuning->name, "how fast");
    EXPECT_EQ(tuning->options.trials, 16u);
    EXPECT_EQ(tuning->options.heldOut, 20u);
    EXPECT_EQ(tuning->options.evaluations, 300);
    EXPECT_EQ(tuning->options.seed, 9u);
    EXPECT_FALSE(tuning->options.racing);
    EXPECT_EQ(tuning->failureCost, 7.0);
    ASSERT_EQ(tuning->cost.size(), 2u);
    EXPECT_EQ(tuning->costText, "-0.5 never + 2.0 off");
    ASSERT_EQ(tuning->options.parameters.size(), 1u);
    const TunedParameter& speed = tuning->options.parameters[0];
    EXPECT_EQ(speed.start, 0.4) << "as it is in the scenario";
    EXPECT_TRUE(speed.logarithmic);
    EXPECT_FALSE(speed.whole);
}

TEST_F(TuningFileTest, WhatBranchesIsNotTuned) {
    std::string& experiment = lane_.texts["x.toml"];
    experiment.insert(experiment.find("scenario ="), "branch = 'time > 0.5'\n");
    EXPECT_THAT(refusal(std::string(Lane::budget) + Lane::speed),
                HasSubstr("t.toml:4:14: experiment: branches; expected one whose variants begin at the start"));
}

TEST_F(TuningFileTest, TheVariantThatIsTunedIsNamed) {
    lane_.texts["x.toml"] +=
        "[[variant]]\nname = \"one\"\n[[variant]]\nname = \"two\"\nset = { \"robot[1].start.y_m\" = "
        "1.0 }\n";
    EXPECT_THAT(refusal(std::string(Lane::budget) + Lane::speed), HasSubstr("t.toml:4:14: experiment: has variants"));
    EXPECT_THAT(refusal(std::string("variant = \"three\"\n") + Lane::budget + Lane::speed),
                HasSubstr("t.toml:5:11: variant: is the name of no variant in x.toml"));
    const auto tuning = read(std::string("variant = \"two\"\n") + Lane::budget + Lane::speed);
    ASSERT_TRUE(tuning) << tuning.error().message();
    ASSERT_EQ(tuning->experiment.variants.size(), 1u);
    EXPECT_EQ(tuning->experiment.variants[0].name, "two");
    lane_.texts["x.toml"] +=
        "[[variant]]\nname = \"fast\"\nset = { \"robot[1].controller.commands[1].v_mps\" = 0.3 }\n";
    EXPECT_THAT(refusal(std::string("variant = \"fast\"\n") + Lane::budget + Lane::speed),
                HasSubstr("is set by the variant; expected it in the experiment's `set`"));
}

TEST_F(TuningFileTest, WhatIsWrongHasItsPlace) {
    const std::string budget = Lane::budget;
    EXPECT_THAT(refusal(budget), HasSubstr("t.toml:1:1: parameter: is missing"));
    EXPECT_THAT(refusal(Lane::speed), HasSubstr("t.toml:1:1: trials: is missing"));
    EXPECT_THAT(refusalOf("trials = 7", "trials = 16"),
                HasSubstr("t.toml:5:10: trials: expected a whole number from 8 to"));
    EXPECT_THAT(refusalOf("held_out = 2", "held_out = 20"),
                HasSubstr("t.toml:6:12: held_out: expected a whole number from 10 to"));
    EXPECT_THAT(refusalOf("evaluations = 31", "evaluations = 300"),
                HasSubstr("t.toml:7:15: evaluations: expected at least twice `trials`"));
    EXPECT_THAT(refusalOf("cost = \"of\"", "cost = \"off\""),
                HasSubstr("t.toml:8:8: cost: \"of\" is no measure of the experiment; it has off, never"));
    EXPECT_THAT(refusalOf("cost = { of = 1.0 }", "cost = \"off\""),
                HasSubstr("t.toml:8:15: cost.of: is no measure of the experiment"));
    EXPECT_THAT(refusalOf("cost = { off = \"a\" }", "cost = \"off\""), HasSubstr("t.toml:8:16: cost.off: "));
    EXPECT_THAT(refusalOf("colour = 1"), HasSubstr("t.toml:14:10: parameter[\"speed\"].colour: is not a known key"));
    EXPECT_THAT(refusalOf("scale = \"square\""), HasSubstr("t.toml:14:9: parameter[\"speed\"].scale: "));
    EXPECT_THAT(refusalOf("whole = true"), HasSubstr("whole: expected whole numbers `from` and `to`"));
    EXPECT_THAT(refusalOf("start = 0.6"),
                HasSubstr("t.toml:14:9: parameter[\"speed\"].start: is now 0.6; expected it"));
    EXPECT_THAT(refusalOf("to = 0.05", "to = 0.5"), HasSubstr("t.toml:13:6: parameter[\"speed\"].to: expected more"));
    EXPECT_THAT(refusalOf("from = 0.0\nscale = \"log\"", "from = 0.05"),
                HasSubstr("t.toml:12:8: parameter[\"speed\"].from: expected more than 0"));
    EXPECT_THAT(refusalOf("path = \"seed\"", "path = \"robot[1].controller.commands[1].v_mps\""),
                HasSubstr("t.toml:11:8: parameter[\"speed\"].path: \"seed\" is not for tuning"));
    EXPECT_THAT(refusalOf("path = []", "path = \"robot[1].controller.commands[1].v_mps\""),
                HasSubstr("expected at least one"));
    EXPECT_THAT(
        refusalOf("path = \"robot[2].mass_kg\"\nstart = 0.1", "path = \"robot[1].controller.commands[1].v_mps\""),
        HasSubstr("t.toml:11:8: parameter[\"speed\"].path: robot[2].mass_kg: names nothing that there is"));
    EXPECT_THAT(refusalOf("path = \"robot[1].controller.speed\"\nstart = 0.1",
                          "path = \"robot[1].controller.commands[1].v_mps\""),
                HasSubstr("robot[\"a\"].controller.speed: is not a known key"));
    EXPECT_THAT(refusalOf("path = \"robot[1].controller.speed\"", "path = \"robot[1].controller.commands[1].v_mps\""),
                HasSubstr("has no number in the scenario; expected `start`"));
    EXPECT_THAT(refusalOf("path = \"robot[1].start.x_m\"", "path = \"robot[1].controller.commands[1].v_mps\""),
                HasSubstr("robot[1].start.x_m is drawn by \"x\" for each trial"));
    EXPECT_THAT(refusalOf("to = 1e9", "to = 0.5"), HasSubstr("with 1000000000.0: "));
    EXPECT_THAT(refusal(budget + Lane::speed + Lane::speed), HasSubstr("is the name of another parameter, too"));
    EXPECT_THAT(refusal(budget + Lane::speed +
                        "[[parameter]]\nname = \"again\"\npath = "
                        "\"robot[1].controller.commands[1].v_mps\"\nfrom = 0.1\nto = 0.5\n"),
                HasSubstr("is that of another parameter, too"));
    EXPECT_THAT(refusal(budget + Lane::speed +
                        "[[parameter]]\nname = \"again\"\npath = "
                        "'robot[\"a\"].controller.commands[1].v_mps'\nfrom = 0.1\nto = 0.5\n"),
                HasSubstr("robot[\"a\"].controller.commands[1].v_mps is that of another parameter, too"));
    EXPECT_THAT(refusalOf("path = 'robot[\"a\"].start.x_m'", "path = \"robot[1].controller.commands[1].v_mps\""),
                HasSubstr("robot[\"a\"].start.x_m is drawn by \"x\" for each trial"));
}

/// What stands in a table that is put there as a whole would be overwritten.
TEST_F(TuningFileTest, PlacesWithinWhatIsSetAreRefused) {
    const std::string set = "{ kind = \"velocity_script\", commands = [{ t_s = 0, v_mps = 0.3 }] }";
    const std::string all = std::string(Lane::budget) + Lane::speed, own = lane_.texts["x.toml"];
    lane_.texts["x.toml"] = own + "[[variant]]\nname = \"v\"\n[variant.set]\n\"robot[1].controller\" = " + set + '\n';
    EXPECT_THAT(refusal("variant = \"v\"\n" + all),
                HasSubstr("robot[1].controller.commands[1].v_mps is set by the variant; "
                          "expected it in the experiment's `set`"));
    lane_.texts["x.toml"] =
        own + "[[draw]]\nname = \"c\"\npath = \"robot[1].controller.commands\"\nof = [[{ t_s = 0, v_mps = 0.3 }]]\n";
    EXPECT_THAT(refusal(all), HasSubstr("robot[1].controller.commands[1].v_mps is drawn by \"c\" for each trial"));
    lane_.texts["x.toml"] = own + "[set]\n\"robot[1].controller\" = " + set + '\n';
    EXPECT_EQ(refusal(all), "") << "of all variants, before they are tuned";
}

TEST_F(TuningFileTest, TheExperimentsMistakesAreItsOwn) {
    lane_.texts["x.toml"] = std::string("trials = 0\n") + Lane::experiment;
    EXPECT_THAT(refusal(std::string(Lane::budget) + Lane::speed), HasSubstr("x.toml:"));
    lane_.texts.erase("x.toml");
    EXPECT_THAT(refusal(std::string(Lane::budget) + Lane::speed), HasSubstr("t.toml:4:14: experiment: "));
    lane_.texts["x.toml"] = Lane::scenario;
    EXPECT_THAT(refusal(std::string(Lane::budget) + Lane::speed), HasSubstr("x.toml:1:10: format: "));
}

}  // namespace
}  // namespace mrose
