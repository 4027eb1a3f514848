#include <atomic>
#include <cmath>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "experiment/experiment.h"
#include "io/file.h"
#include "io/toml_text.h"
#include "report/validation_report.h"
#include "scenario/description_library.h"
#include "support/temporary_folder.h"
#include "support/workshop.h"
#include "validation/validation_results.h"

namespace mrose {
namespace {

using testing::HasSubstr;

constexpr const char* laneScenario = R"(format = "mrose scenario"
version = 1
name = "lane"
environment = "e.toml"
duration_s = 4.0
[[robot]]
name = "a"
type = "r.toml"
start = { x_m = 0.0, y_m = 0.0 }
controller = { kind = "velocity_script", commands = [{ t_s = 0, v_mps = 0.4 }] }
)";
constexpr const char* exactRobot = R"(format = "mrose robot"
version = 1
name = "r"
shape = "d.toml"
mass_kg = 10.0
control_period_s = 0.1
[kinematics]
)";
constexpr const char* discShape =
    "format = \"mrose shape\"\nversion = 1\nname = \"d\"\n[[part]]\ncircle = { radius_m = 0.2 }\n";
constexpr const char* openPlace = "format = \"mrose environment\"\nversion = 1\nname = \"e\"\n";
constexpr const char* laneExperiment = R"(format = "mrose experiment"
version = 1
name = "lane"
scenario = "s.toml"
trials = 3
[[draw]]
name = "x"
path = "robot[1].start.x_m"
from = -3.0
to = 3.0
[measures]
way_m = 'robot[1].x - draw.x'
far = 'robot[1].x - draw.x > 1.5 and 1 or 0'
unknown_m = 'draw.x > 0 and 1 or 0/0'
)";
constexpr const char* laneValidation = R"(format = "mrose validation"
version = 1
name = "faster"
experiment = "x.toml"
trials = 20
first_trial = 101
[before]
name = "slow"
set = { "robot[1].controller.commands[1].v_mps" = 0.2 }
[after]
name = "fast"
set = { "robot[1].controller.commands[1].v_mps" = 0.5 }
[simulation]
name = "simulator"
[reality]
set = { "robot[1].type.kinematics.v" = { gain = 0.8 } }
[[measure]]
name = "way_m"
better = "more"
unit = "m"
[[measure]]
name = "far"
better = "more"
yes_no = true
)";

/// The same experiment with variants of its own.
std::string withSweep() {
    return replaced(laneExperiment, "[measures]",
                    "[[variant]]\nname = \"as it is\"\n[[sweep]]\nname = \"pace\"\nvalues = [1, 2, 3]\n"
                    "scaled = { \"robot[1].controller.commands[1].v_mps\" = 0.1 }\n[measures]");
}

/// A validation of files in memory.
class ValidationTest : public testing::Test {
protected:
    std::map<std::string, std::string> texts_{{"s.toml", laneScenario},
                                              {"r.toml", exactRobot},
                                              {"d.toml", discShape},
                                              {"e.toml", openPlace},
                                              {"x.toml", laneExperiment}};
    std::string text_ = laneValidation;
    TemporaryFolder folder_;
    ExperimentOptions options_;

    Expected<Validation> read(const std::string& text) {
        texts_["v.toml"] = text;
        KeptDescriptions source(texts_);
        const auto file = DescriptionLibrary(source).file("v.toml", {});
        if (!file) return tl::unexpected(file.error());
        return readValidation(*file, source);
    }
    std::string refusal(const std::string& from, const std::string& to) {
        const auto validation = read(replaced(laneValidation, from, to));
        return validation ? "" : validation.error().message();
    }
    std::filesystem::path place(const std::string& name = "out") const { return folder_.path() / name; }

    /// Runs it to its end.
    ValidationResult validated(const Validation& validation, const std::string& name = "out") {
        const auto summary = runExperiment(validation.experiment, options_, place(name));
        EXPECT_TRUE(summary) << summary.error().message();
        EXPECT_TRUE(summary && summary->complete);
        auto results = readResultsTable(place(name));
        EXPECT_TRUE(results) << results.error().message();
        if (!results) return {};
        results_ = *results;
        auto result = validationResult(validation, results_);
        EXPECT_TRUE(result) << result.error().message();
        return result ? std::move(*result) : ValidationResult{};
    }
    ResultsTable results_;
};

/// From the start on it is 4 s of driving; a branch after 1 s would leave 3 s of it.
TEST_F(ValidationTest, SweepsOfTheExperimentAreNotRun) {
    texts_["x.toml"] = withSweep();
    const auto validation = read(replaced(laneValidation, "trials = 20", "trials = 20\nvariant = \"as it is\""));
    ASSERT_TRUE(validation) << validation.error().message();
    EXPECT_EQ(validation->experiment.variants.size(), 4u);
    const ValidationResult result = validated(*validation);
    for (const CellRuns& cell : result.cells) EXPECT_EQ(cell.runs, 20) << cell.name;
}

TEST_F(ValidationTest, ExperimentThatBranchesMayBeRunFromTheStart) {
    texts_["x.toml"] =
        replaced(laneExperiment, "trials = 3\n", "trials = 3\nbranch = 'time > 0.995'\nduration_s = 3.0\n");
    const auto branching = read(text_);
    ASSERT_TRUE(branching) << branching.error().message();
    const auto whole = read(replaced(laneValidation, "first_trial = 101", "first_trial = 101\nfrom_start = true"));
    ASSERT_TRUE(whole) << whole.error().message();
    const auto before = [](const ValidationResult& result) { return result.measures.at(0).cells[0].value; };
    EXPECT_NEAR(before(validated(*branching)), 0.4 * 4, 0.03) << "its script was begun before";
    EXPECT_NEAR(before(validated(*whole, "whole")), 0.2 * 3, 1e-9);
}

/// Without noise a robot that is told v drives v t, and in the reality four fifths of that.
TEST_F(ValidationTest, GainsAreWhatTheyAreInClosedForm) {
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    ASSERT_EQ(validation->experiment.variants.size(), 4u);
    EXPECT_EQ(validation->experiment.variants[1].name, "fast in simulator");
    EXPECT_EQ(validation->experiment.variants[2].name, "slow in reality");
    const ValidationResult result = validated(*validation);
    ASSERT_EQ(result.measures.size(), 2u);
    const MeasureValidation& way = result.measures[0];
    ASSERT_EQ(way.trials.size(), 20u);
    EXPECT_EQ(way.trials.front().trial, 101u);
    EXPECT_EQ(way.trials.back().trial, 120u);
    const double expected[] = {0.8, 2.0, 0.64, 1.6};
    for (std::size_t place = 0; place < validationCells; ++place)
        EXPECT_NEAR(way.cells[place].value, expected[place], 1e-9) << place;
    EXPECT_NEAR(way.gain[0].value, 1.2, 1e-9);
    EXPECT_NEAR(way.gain[1].value, 0.96, 1e-9);
    EXPECT_NEAR(way.survives.value, 0.8, 1e-9);
    EXPECT_NEAR(way.survives.high, 0.8, 1e-6) << "there is no noise";
    EXPECT_NEAR(way.worse[1].value, 0.4, 1e-9) << "by so much the fast one is worse in the reality";
    const MeasureValidation& far = result.measures[1];
    EXPECT_EQ(far.cells[1].value, 1);
    EXPECT_NEAR(far.cells[1].low, 1 / (1 + 1.959964 * 1.959964 / 20), 1e-6) << "Wilson, of all";
    EXPECT_EQ(far.cells[0].value, 0);
    // Each run lasts 4 s.
    EXPECT_EQ(result.account.simulatedRuns, 40);
    EXPECT_NEAR(result.account.simulatedHours, 40 * 4 / 3600.0, 1e-9);
    EXPECT_FALSE(result.account.logMinutes);
}

TEST_F(ValidationTest, WhereNothingIsGainedNothingSurvives) {
    const auto validation = read(replaced(laneValidation, "v_mps\" = 0.5", "v_mps\" = 0.1"));
    ASSERT_TRUE(validation) << validation.error().message();
    const ValidationResult result = validated(*validation);
    EXPECT_NEAR(result.measures[0].gain[0].value, -0.4, 1e-9);
    EXPECT_TRUE(std::isnan(result.measures[0].survives.value));
}

TEST_F(ValidationTest, IntervalsArePairedByTrial) {
    texts_["r.toml"] += "[motion_noise]\ndistance_per_distance = 0.5\n";
    text_ = replaced(text_, "trials = 20\n", "trials = 20\nseeds = 3\n");
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    const ValidationResult result = validated(*validation);
    const MeasureValidation& way = result.measures[0];
    // The same from the rows, by hand.
    const std::size_t measure = results_.columnOf("measure.way_m"), variant = results_.columnOf("variant");
    double gains[20] = {}, sum = 0, squares = 0;
    for (std::size_t row = 0; row < results_.rows.size(); ++row) {
        const auto trial = static_cast<std::size_t>(results_.number(row, 0)) - 101;
        const double sign = results_.number(row, variant) == 2 ? 1 : results_.number(row, variant) == 1 ? -1 : 0;
        gains[trial] += sign * results_.number(row, measure) / 3;
    }
    for (const double gain : gains) sum += gain;
    for (const double gain : gains) squares += (gain - sum / 20) * (gain - sum / 20);
    EXPECT_NEAR(way.gain[0].value, sum / 20, 1e-9);
    EXPECT_NEAR(way.gain[0].high - way.gain[0].value, 2.0930 * std::sqrt(squares / 19 / 20), 1e-4);
    EXPECT_GT(squares, 0);
    // The largest differences, each in another trial.
    double largest = 0;
    std::map<std::tuple<double, double, bool>, double> simulated;
    for (std::size_t row = 0; row < results_.rows.size(); ++row) {
        const double of = results_.number(row, variant);
        const std::tuple key(results_.number(row, 0), results_.number(row, 1), of == 2 || of == 4);
        if (of <= 2) simulated[key] = results_.number(row, measure);
    }
    for (std::size_t row = 0; row < results_.rows.size(); ++row) {
        const double of = results_.number(row, variant);
        const std::tuple key(results_.number(row, 0), results_.number(row, 1), of == 4);
        if (of >= 3) largest = std::max(largest, std::abs(simulated.at(key) - results_.number(row, measure)));
    }
    ASSERT_EQ(result.disagreements.size(), shownDisagreements);
    EXPECT_NEAR(result.disagreements[0].difference(), largest, 1e-9);
    std::set<std::uint32_t> trials;
    for (std::size_t i = 0; i < result.disagreements.size(); ++i) {
        const Disagreement& one = result.disagreements[i];
        EXPECT_TRUE(trials.insert(one.trial).second);
        if (i > 0) {
            EXPECT_LE(one.difference(), result.disagreements[i - 1].difference());
        }
        ASSERT_TRUE(one.realRow);
        EXPECT_EQ(results_.number(*one.realRow, 0), one.trial);
        EXPECT_EQ(results_.number(one.simulatedRow, measure), one.simulated);
    }
}

/// `far` goes from no to yes in two of three trials.
TEST_F(ValidationTest, GainsOfYesAndNoAreAtMostAllOfIt) {
    texts_["real.csv"] =
        "trial,when,way_m,far\n101,before,1,0\n101,after,1,1\n102,before,1,0\n102,after,1,1\n"
        "103,before,9,0\n103,after,1,0\n";
    text_ = replaced(text_, "set = { \"robot[1].type.kinematics.v\" = { gain = 0.8 } }", "results = \"real.csv\"");
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    const ValidationResult result = validated(*validation);
    const MeasureValidation &way = result.measures[0], &far = result.measures[1];
    EXPECT_NEAR(far.gain[1].value, 2.0 / 3, 1e-9);
    EXPECT_LT(far.gain[1].low, 0);
    EXPECT_EQ(far.gain[1].high, 1);
    EXPECT_NEAR(far.worse[1].value, 1.0 / 3, 1e-9);
    EXPECT_EQ(far.worse[1].high, 1);
    EXPECT_NEAR(way.gain[1].low, -8.0 / 3 - 4.30265 * 8 / 3, 1e-3) << "a way may be any number";
}

/// How long and how often something holds is not less than 0, whoever measures it.
TEST_F(ValidationTest, TimesAreNotNegative) {
    texts_["x.toml"] += "late_s = { seconds = 'robot[1].x - draw.x > 0.5' }\n";
    texts_["real.csv"] =
        "trial,when,way_m,far,late_s\n101,before,1,0,9\n101,after,1,1,0\n102,before,1,0,0\n102,after,1,1,0\n";
    text_ = replaced(text_, "set = { \"robot[1].type.kinematics.v\" = { gain = 0.8 } }", "results = \"real.csv\"") +
            "[[measure]]\nname = \"late_s\"\nbetter = \"less\"\n";
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    const MeasureValidation late = validated(*validation).measures[2];
    EXPECT_EQ(late.cells[2].value, 4.5);
    EXPECT_EQ(late.cells[2].low, 0);
    EXPECT_LT(late.gain[1].low, 0) << "it may be worse";
}

TEST_F(ValidationTest, ResumedOnAnyNumberOfThreadsIsTheSame) {
    texts_["r.toml"] += "[motion_noise]\ndistance_per_distance = 0.5\n";
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    std::string whole;
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        whole = validationCsv(validated(*validation, "whole"), *validation);
    }
    std::atomic<int> begun{0};
    options_.begins = [&](const RunKey&) { ++begun; };
    options_.goesOn = [&] { return begun < 30; };
    const auto part = runExperiment(validation->experiment, options_, place("parts"));
    ASSERT_TRUE(part) << part.error().message();
    ASSERT_FALSE(part->complete);
    options_ = {};
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    EXPECT_EQ(validationCsv(validated(*validation, "parts"), *validation), whole);
    const std::string rows = readFile(place("whole") / "results.csv").value_or("none");
    EXPECT_EQ(readFile(place("parts") / "results.csv").value_or(""), rows);
}

TEST_F(ValidationTest, RealityMayBeWhatWasMeasured) {
    texts_["real.csv"] = "trial,when,way_m,far\n";
    for (int trial = 101; trial <= 110; ++trial)
        texts_["real.csv"] += std::to_string(trial) + ",before,0.5,0\n" + std::to_string(trial) + ",after,1.1,1\n";
    text_ = replaced(text_, "set = { \"robot[1].type.kinematics.v\" = { gain = 0.8 } }", "results = \"real.csv\"");
    text_ += "[account]\nlog_minutes = 30\nsimulated_hours = 2\nreset_s = 36\n";
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    EXPECT_EQ(validation->experiment.variants.size(), 2u) << "it is not run";
    const ValidationResult result = validated(*validation);
    const MeasureValidation& way = result.measures[0];
    EXPECT_EQ(way.trials.size(), 10u);
    EXPECT_EQ(way.leftOut, 10u) << "trials that nobody measured";
    EXPECT_NEAR(way.gain[1].value, 0.6, 1e-9);
    EXPECT_NEAR(way.survives.value, 0.5, 1e-9);
    EXPECT_TRUE(result.cells[2].measured);
    EXPECT_FALSE(result.disagreements.at(0).realRow);
    const double hours = 2 + 40 * 4 / 3600.0;
    EXPECT_NEAR(result.account.sparedHours(), hours + 40 * 36 / 3600.0 - 0.5, 1e-9);
    const std::string page = validationReportHtml(*validation, result, results_, {});
    EXPECT_THAT(page, HasSubstr("measured in reality"));
    EXPECT_EQ(page.find("<p class=\"notice\""), page.npos) << "it is not synthetic";
}

TEST_F(ValidationTest, TrialsWithoutANumberAreLeftOutAndCounted) {
    text_ += "[[measure]]\nname = \"unknown_m\"\nbetter = \"less\"\n";
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    const ValidationResult result = validated(*validation);
    const MeasureValidation& unknown = result.measures[2];
    EXPECT_GT(unknown.leftOut, 2u);
    EXPECT_EQ(unknown.leftOut + unknown.trials.size(), 20u);
    EXPECT_EQ(unknown.gain[0].value, 0);
    EXPECT_TRUE(std::isnan(unknown.survives.value));
    text_ =
        replaced(text_, "name = \"way_m\"\nbetter = \"more\"", "name = \"way_m\"\nbetter = \"more\"\nyes_no = true");
    const auto wrong = read(text_);
    ASSERT_TRUE(wrong) << wrong.error().message();
    const auto refused = validationResult(*wrong, results_);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), testing::StartsWith("v.toml:20:10: measure[\"way_m\"]: is 0.8"));
    EXPECT_THAT(refused.error().message(), HasSubstr("expected 1 or 0"));
}

/// A controller that crashes gains nothing by it, whatever was measured until then.
TEST_F(ValidationTest, RunsThatAFaultEndedHaveNoNumber) {
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    validated(*validation);
    const std::size_t end = results_.columnOf("end"), way = results_.columnOf("measure.way_m");
    for (std::vector<std::string>& row : results_.rows)
        if (row[0] <= "105" && row[results_.columnOf("variant")] == "2") row[end] = "fault", row[way] = "1000.0";
    const auto result = validationResult(*validation, results_);
    ASSERT_TRUE(result) << result.error().message();
    EXPECT_EQ(result->cells[1].faulty, 5);
    for (const MeasureValidation& of : result->measures) {
        EXPECT_EQ(of.leftOut, 5u);
        EXPECT_EQ(of.trials.front().trial, 106u);
    }
    EXPECT_NEAR(result->measures[0].gain[0].value, 1.2, 1e-9);
    for (const Disagreement& one : result->disagreements) EXPECT_LT(one.simulated, 3);
    EXPECT_THAT(validationReportHtml(*validation, *result, results_, {}), HasSubstr("left out: ended by a fault"));
}

/// Told with its line, and as soon as the first such run is over.
TEST_F(ValidationTest, MeasureOfYesAndNoIsCheckedAtItsFirstRun) {
    const auto validation = read(
        replaced(text_, "name = \"way_m\"\nbetter = \"more\"", "name = \"way_m\"\nbetter = \"more\"\nyes_no = true"));
    ASSERT_TRUE(validation) << validation.error().message();
    options_.fits = [&](const RunKey& key, const RowOutcome& outcome) {
        return checkOutcome(*validation, key, outcome);
    };
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    std::int64_t done = 0;
    options_.progress = [&](std::int64_t now, std::int64_t) { done = now; };
    const auto refused = runExperiment(validation->experiment, options_, place());
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), testing::StartsWith("v.toml:20:10: measure[\"way_m\"]: is 0.8"));
    EXPECT_EQ(done, 0);
}

TEST_F(ValidationTest, PageSaysWhatSurvivesAndWhereTheyDisagree) {
    texts_["r.toml"] += "[motion_noise]\ndistance_per_distance = 0.5\n";
    options_.window = "mrose-gui v.toml";
    const auto validation = read(text_);
    ASSERT_TRUE(validation) << validation.error().message();
    const ValidationResult result = validated(*validation);
    ValidationContext context;
    context.window = "mrose-gui", context.folder = "out", context.commandLine = "mrose validate v.toml -o out";
    const auto written = writeValidationReport(*validation, result, results_, context, place());
    ASSERT_TRUE(written) << written.error().message();
    const std::string page = readFile(place() / "report.html").value_or("");
    for (const char* text :
         {"synthetic reality", "fast in simulator", "slow in reality", "gain in simulator",
          "mrose-gui out/disagreements.csv", "mrose-gui v.toml --trial ", "<svg", "trials 101 to 120"})
        EXPECT_THAT(page, HasSubstr(text));
    const auto list = readResultsTable(place() / "disagreements.csv");
    ASSERT_TRUE(list) << list.error().message();
    EXPECT_EQ(list->columns, results_.columns);
    EXPECT_EQ(list->rows.size(), 2 * result.disagreements.size());
    EXPECT_EQ(list->rows[1], results_.rows[*result.disagreements[0].realRow]);
}

TEST_F(ValidationTest, VariantOfTheExperimentHoldsInAllCells) {
    texts_["x.toml"] +=
        "[[variant]]\nname = \"turning\"\nset = { \"robot[1].start.heading_deg\" = 180 }\n"
        "[[variant]]\nname = \"plain\"\n";
    const auto missing = read(text_);
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message(), "v.toml:1:1: variant: is missing: the experiment has \"turning\", \"plain\"");
    const auto wrong = read(replaced(text_, "trials = 20", "variant = \"tuning\"\ntrials = 20"));
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message(), HasSubstr("is no variant of the experiment"));
    const auto validation = read(replaced(text_, "trials = 20", "variant = \"turning\"\ntrials = 20"));
    ASSERT_TRUE(validation) << validation.error().message();
    EXPECT_NEAR(validated(*validation).measures[0].cells[0].value, -0.8, 1e-9);
}

TEST_F(ValidationTest, SettingsFilesHoldAndSayWhichTrialsTheyUsed) {
    texts_["t.toml"] =
        "format = \"mrose settings\"\nversion = 1\n[set]\n\"robot[1].controller.commands[1].v_mps\" = 0.5\n"
        "[evidence]\nexperiment = \"folder/x.toml\"\ntrials = 90\nheld_out_from = 91\nheld_out_to = 100\n";
    const std::string set = "set = { \"robot[1].controller.commands[1].v_mps\" = 0.5 }";
    const auto validation = read(replaced(text_, set, "settings = \"t.toml\""));
    ASSERT_TRUE(validation) << validation.error().message();
    EXPECT_TRUE(validation->notes.empty());
    EXPECT_NEAR(validated(*validation).measures[0].survives.value, 0.8, 1e-9);
    EXPECT_NEAR(validated(*validation).measures[0].cells[1].value, 2.0, 1e-9);
    texts_["t.toml"] = replaced(texts_["t.toml"], "held_out_to = 100", "held_out_to = 101");
    const auto overlapping = read(replaced(text_, set, "settings = \"t.toml\""));
    ASSERT_FALSE(overlapping);
    EXPECT_EQ(overlapping.error().message(),
              "v.toml:5:10: trials: are 101 to 120; \"fast\" used 91 to 101; expected others, by `first_trial`");
    texts_["t.toml"] = replaced(texts_["t.toml"], "folder/x.toml", "other.toml");
    EXPECT_TRUE(read(replaced(text_, set, "settings = \"t.toml\""))) << "trials of another experiment";
    texts_["t.toml"] = texts_["t.toml"].substr(0, texts_["t.toml"].find("[evidence]"));
    const auto silent = read(replaced(text_, set, "settings = \"t.toml\""));
    ASSERT_TRUE(silent) << silent.error().message();
    ASSERT_EQ(silent->notes.size(), 1u);
    EXPECT_THAT(silent->notes[0], HasSubstr("\"fast\""));
    texts_["t.toml"] = replaced(texts_["t.toml"], "v_mps", "speed");
    const auto wrong = read(replaced(text_, set, "settings = \"t.toml\""));
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message(), HasSubstr("t.toml:4:"));
}

TEST_F(ValidationTest, EveryMistakeNamesItsPlace) {
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"name = \"faster\"\n", "", "v.toml:1:1: name: is missing"},
        {"x.toml", "y.toml",
         "v.toml:4:14: experiment: \"y.toml\" was not found; expected y.toml or "
         "mrose:resources/experiments/y.toml"},
        {"x.toml", "s.toml", "s.toml:1:10: format: is \"mrose scenario\"; expected one of \"mrose experiment\""},
        {"trials = 20", "trials = 0", "v.toml:5:10: trials: expected a whole number from 1 to 10000000"},
        {"first_trial = 101", "frist_trial = 101",
         "v.toml:6:15: frist_trial: is not a known key; did you mean first_trial?"},
        {"[before]\nname = \"slow\"\n", "[before]\nname = \"\"\n",
         "v.toml:8:8: before.name: expected a name of 1 to 64 printable characters"},
        {"name = \"slow\"", "name = \"as slow as ever it was before\"",
         "v.toml:8:8: before.name: expected at most 24 characters"},
        {"\"robot[1].controller.commands[1].v_mps\" = 0.5", "\"robot[2].controller.v_mps\" = 0.5",
         "v.toml:12:39: after.set.robot[2].controller.v_mps: "},
        {"v_mps\" = 0.5", "v\" = 0.5", "v.toml:12:47: after.set.robot[1].controller.commands[1].v: "},
        {"gain = 0.8", "gian = 0.8", "v.toml:16:40: reality.set.robot[1].type.kinematics.v: "},
        {"[reality]\nset = { \"robot[1].type.kinematics.v\" = { gain = 0.8 } }\n", "",
         "v.toml:1:1: reality: says nothing of the reality; expected `set` or `results`"},
        {"[reality]\n", "[reality]\nresults = \"none.csv\"\n",
         "v.toml:16:11: reality.results: are there instead of `set`; expected one of them"},
        {"\"robot[1].type.kinematics.v\" = { gain = 0.8 }", "\"robot[1].controller.commands[1].v_mps\" = 0.1",
         "v.toml:9:51: before.set.robot[1].controller.commands[1].v_mps: is set by \"reality\", too"},
        {"name = \"way_m\"", "name = \"way\"",
         "v.toml:18:8: measure[\"way\"].name: is no measure of the experiment; expected one of way_m, far, unknown_m"},
        {"name = \"far\"", "name = \"way_m\"", "v.toml:22:8: measure[\"way_m\"].name: is there twice"},
        {"better = \"more\"\nunit", "better = \"most\"\nunit",
         "v.toml:19:10: measure[\"way_m\"].better: is \"most\"; expected one of \"less\", \"more\""},
        {"yes_no = true", "yes_no = 1", "v.toml:24:10: measure[\"far\"].yes_no: expected true or false"},
        {"yes_no = true\n", "yes_no = true\n[account]\nlog_minutes = -1\n",
         "v.toml:26:15: account.log_minutes: is -1.0; expected 0.0 to 1000000000.0"},
        {"name = \"fast\"\n", "name = \"fast\"\nused_trials = [[1, 100], [120, 130]]\n",
         "v.toml:5:10: trials: are 101 to 120; \"fast\" used 120 to 130; expected others, by `first_trial`"},
        {"name = \"fast\"\n", "name = \"fast\"\nused_trials = [1]\n", "v.toml:12:16: after.used_trials: "},
    };
    for (const auto& [from, to, message] : cases) EXPECT_THAT(refusal(from, to), HasSubstr(message)) << to;
    EXPECT_EQ(refusal("name = \"fast\"\n", "name = \"fast\"\nused_trials = [[1, 100]]\n"), "");
    texts_["real.csv"] = "trial,when,way_m,far\n5,before,1,1\n5,after,1,1\n";
    const std::string reality = "set = { \"robot[1].type.kinematics.v\" = { gain = 0.8 } }";
    EXPECT_EQ(refusal(reality, "results = \"real.csv\""),
              "v.toml:5:10: trials: do not hold trial 5 of `reality.results`");
    texts_["real.csv"] = "trial,way_m,far\n";
    EXPECT_EQ(refusal(reality, "results = \"real.csv\""),
              "real.csv:1: has no column \"when\"; expected trial, when and the measures");
}

}  // namespace
}  // namespace mrose
