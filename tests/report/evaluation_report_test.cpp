#include "report/evaluation_report.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "assessment/test_models.h"
#include "drawing/markup.h"
#include "drawing/svg_plot.h"
#include "io/file.h"
#include "io/format.h"
#include "report/evaluation_files.h"
#include "report/path_figures.h"
#include "support/markup.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::Not;

Command wandering(double t) { return {0.2, std::fmod(t, 20) < 5 ? 0.4 : std::fmod(t, 20) < 15 ? 0.0 : -0.4}; }

class Report : public testing::Test {
protected:
    Report() {
        Log log = logOf({obedientTrajectory(0, 120 * second, wandering)});
        log.source = "logs/<a> & \"b\"";
        log.robots[0].robot = "r<2>";
        log.robots[0].defects.blips = 4711;
        log.files = {{"logs/<file>", "00ff00ff00ff00ff"}};
        const std::vector<NamedModel> models{NamedModel::same("net <b> & co", right_),
                                             NamedModel::same("fast, too", fast_)};
        evaluation_ = *evaluate(log, models);
        context_.program = "mrose <1>";
        context_.modelFacts = {{"kind<", "tanh & \"more\""}};
        context_.trainingLogs = {{"train<ing>", "123456789abcdef0"}};
        context_.commandLine = "mrose evaluate 'x' > y";
    }

    HeldCommandModel right_{second / 10, 1.01}, fast_{second / 10, 1.2};
    Evaluation evaluation_;
    ReportContext context_;
};

TEST_F(Report, IsWellFormedAndEscapesAllText) {
    const std::string html = reportHtml(evaluation_, context_);
    EXPECT_EQ(markupError(html), "");
    for (const char* raw : {"<b> & co", "<a> &", "r<2>", "<file>", "train<ing>", "kind<\"", "mrose <1>"})
        EXPECT_THAT(html, Not(HasSubstr(raw)));
    for (const char* text :
         {"net &lt;b&gt; &amp; co", "logs/&lt;a&gt; &amp; &quot;b&quot;", "r&lt;2&gt;", "train&lt;ing&gt;",
          "tanh &amp; &quot;more&quot;", "00ff00ff00ff00ff", "123456789abcdef0", "&#39;x&#39; &gt; y"})
        EXPECT_THAT(html, HasSubstr(text));
}

TEST_F(Report, HoldsTheNumbersAndNothingUndefined) {
    const std::string html = reportHtml(evaluation_, context_);
    const Summary& all = evaluation_.models[0].all;
    EXPECT_THAT(html, HasSubstr("<b>" + fixed(all.p, 2) + "\u00a0%</b> of the path driven (P)"));
    EXPECT_THAT(html, HasSubstr(fixed(evaluation_.models[1].all.p, 2)));
    EXPECT_THAT(html, HasSubstr("4711"));
    for (const char* undefined : {"nan", "NaN", "inf<", "-0.00<", "–,", "\"–\""}) {
        const std::size_t at = html.find(undefined);
        // Words may hold these letters; attributes and cells may not.
        if (at != std::string::npos) {
            EXPECT_TRUE(std::isalpha(html[at - 1])) << html.substr(at - 20, 40);
        }
    }
}

TEST_F(Report, NeedsNothingFromElsewhere) {
    const std::string html = reportHtml(evaluation_, context_);
    for (const char* link : {"<script", "src=", "href=\"http", "url(", "@import", "<link"})
        EXPECT_THAT(html, Not(HasSubstr(link)));
    EXPECT_THAT(html, HasSubstr("prefers-color-scheme: dark"));
}

TEST_F(Report, SaysSyntheticWhereverTheLogIs) {
    EXPECT_THAT(reportHtml(evaluation_, context_), Not(HasSubstr("simulated robot")));
    EXPECT_THAT(reportHtml(evaluation_, context_), HasSubstr("Real against predicted paths"));
    evaluation_.log.synthetic = true;
    const std::string html = reportHtml(evaluation_, context_);
    EXPECT_THAT(html, HasSubstr("Logged against predicted paths"));
    EXPECT_THAT(html, HasSubstr("logged path</span>"));
    EXPECT_THAT(html, Not(HasSubstr("real path")));
    EXPECT_THAT(html, Not(HasSubstr("real robot")));
    EXPECT_THAT(html, HasSubstr("synthetic data</span>"));
    EXPECT_THAT(html, HasSubstr("(synthetic)</title>"));
    EXPECT_THAT(html, HasSubstr("The log comes from a simulated robot"));
}

TEST_F(Report, NoticesComeBeforeTheNumbers) {
    context_.notices = {"Learned from <this> log."};
    const std::string html = reportHtml(evaluation_, context_);
    const std::size_t notice = html.find("Learned from &lt;this&gt; log.");
    ASSERT_NE(notice, std::string::npos);
    EXPECT_LT(notice, html.find("class=\"lead\""));
    EXPECT_EQ(nlohmann::json::parse(resultsJson(evaluation_, context_))["notices"][0], context_.notices[0]);
}

TEST_F(Report, NumbersWindowsAlikeEverywhere) {
    context_.chosen = {1};
    const std::string html = reportHtml(evaluation_, context_), start = secondsText(evaluation_.log.windows[1].start);
    EXPECT_THAT(html, HasSubstr("window\u00a02 · from\u00a0" + start));
    EXPECT_THAT(html, HasSubstr("<title>window 2, from " + start));
    EXPECT_THAT(resultsCsv(evaluation_), HasSubstr(",2,0,r<2>,a," + start));
    const auto json = nlohmann::json::parse(resultsJson(evaluation_, context_));
    EXPECT_EQ(json["windows"][1]["window"], 2);
    EXPECT_EQ(json["windows"][1]["t_start"], start);
}

/// Logs may have clocks of their own: Unix times on a page would tell nothing.
TEST_F(Report, CountsFromTheStartOfTheDriveAndFilesFromThatOfTheLog) {
    const Nanoseconds unixTime = 1'248'444'000 * second;
    Log log =
        logOf({obedientTrajectory(unixTime, 60 * second, wandering), obedientTrajectory(0, 60 * second, wandering)});
    log.robots[0].trajectories[1].name = "b";
    // A robot that began to be commanded 4 s before: its drive is the same.
    log.robots.push_back(log.robots[0]);
    log.robots[1].robot = "early";
    log.robots[1].trajectories.resize(1);
    log.robots[1].trajectories[0].commands.insert(log.robots[1].trajectories[0].commands.begin(),
                                                  {unixTime - 4 * second, {}});
    const NamedModel model = NamedModel::same("m", right_);
    const auto evaluation = evaluate(log, {&model, 1});
    ASSERT_TRUE(evaluation);
    for (std::size_t i = 0; i < evaluation->log.windows.size(); ++i)
        EXPECT_EQ(evaluation->log.driveStarts[i], evaluation->log.trajectories[i] == "b" ? 0 : unixTime - 4 * second);
    const std::string html = reportHtml(*evaluation, {});
    const Nanoseconds first = evaluation->log.windows[0].start;
    EXPECT_GE(first, unixTime);
    EXPECT_THAT(html, HasSubstr("<title>window 1, from " + fixed(toSeconds(first - unixTime) + 4, 1) + " s"));
    EXPECT_THAT(html, Not(HasSubstr("12484440")));
    EXPECT_THAT(resultsCsv(*evaluation), HasSubstr("," + secondsText(first) + ","));
}

TEST_F(Report, DrawsTheBestOfTheOthers) {
    Log log = logOf({obedientTrajectory(0, 120 * second, wandering)});
    const HeldCommandModel slow{second / 10, 0.5};
    const std::vector<NamedModel> models{NamedModel::same("net", right_), NamedModel::same("bad", slow),
                                         NamedModel::same("good", fast_)};
    const Evaluation evaluation = *evaluate(log, models);
    EXPECT_EQ(drawnModels(evaluation), (std::vector<std::size_t>{0, 2}));
    EXPECT_THAT(pathLegend(evaluation), HasSubstr("good (best of the others by P)"));
    EXPECT_THAT(pathLegend(evaluation), Not(HasSubstr("bad")));
    EXPECT_THAT(pathFigure(evaluation, 0), HasSubstr("line s2 thin"));
    EXPECT_THAT(pathFigure(evaluation, 0), Not(HasSubstr("line s1")));
    EXPECT_EQ(drawnModels(evaluation_), (std::vector<std::size_t>{0, 1}));
}

/// Of a handful of windows intervals and tails say nothing.
TEST_F(Report, FewWindowsHaveNeitherIntervalNorTail) {
    ASSERT_LT(evaluation_.log.windows.size(), 20u);
    ASSERT_GE(evaluation_.log.windows.size(), 10u);
    const std::string some = reportHtml(evaluation_, context_);
    EXPECT_THAT(some, Not(HasSubstr("interval ")));
    EXPECT_THAT(some, HasSubstr("of " + std::to_string(evaluation_.log.windows.size()) + ": too few for an interval"));
    EXPECT_THAT(some, HasSubstr("one window in ten"));
    EXPECT_THAT(some, HasSubstr("90th percentile "));
    const NamedModel model = NamedModel::same("m", right_);
    const Log longer = logOf({obedientTrajectory(0, 250 * second, wandering)});
    EXPECT_THAT(reportHtml(*evaluate(longer, {&model, 1}), {}), HasSubstr("95\u00a0% interval "));
    const Log shorter = logOf({obedientTrajectory(0, 60 * second, wandering)});
    const std::string few = reportHtml(*evaluate(shorter, {&model, 1}), {});
    EXPECT_THAT(few, Not(HasSubstr("one window in ten")));
    EXPECT_THAT(few, Not(HasSubstr(", 90th percentile ")));
}

TEST_F(Report, OneIsNoPlural) {
    const Log shorter = logOf({obedientTrajectory(0, 25 * second, wandering)});
    const NamedModel model = NamedModel::same("m", right_);
    Evaluation one = *evaluate(shorter, {&model, 1});
    ASSERT_EQ(one.log.windows.size(), 2u);
    EXPECT_THAT(reportHtml(one, {}), HasSubstr("2 windows of 10 s"));
    one.log.windows.pop_back();
    one.models[0].errors.pop_back();
    one.log.files = {{"a", "b"}};
    one.log.floor->pairs.resize(1);
    const std::string html = reportHtml(one, {});
    EXPECT_THAT(html, HasSubstr("1 window of 10 s"));
    EXPECT_THAT(html, HasSubstr("1 file with hashes"));
    EXPECT_THAT(html, HasSubstr("(1 <a href=\"#floor\">pair</a>)"));
    EXPECT_THAT(html, HasSubstr("10 s, 1 pair<"));
    EXPECT_THAT(html, HasSubstr("</b> of them, best match first, shares no instant and is counted."));
}

TEST_F(Report, NamesSpreadAndFloorApart) {
    ASSERT_TRUE(evaluation_.log.floor);
    evaluation_.log.floor->pairs.resize(1);
    evaluation_.log.floor->spread.p = 4.5678;
    evaluation_.log.floor->best.p = 3.2301;
    const std::string html = reportHtml(evaluation_, context_);
    EXPECT_THAT(html, HasSubstr("4.57\u00a0% apart (the spread)"));
    EXPECT_THAT(html, HasSubstr("3.23\u00a0% there (the floor)"));
}

TEST_F(Report, FolderIsCheckedWithoutMakingIt) {
    const auto folder = std::filesystem::temp_directory_path() / ("mrose_check_" + std::to_string(getpid()));
    EXPECT_TRUE(checkReportFolder(folder / "deep" / ""));
    EXPECT_FALSE(std::filesystem::exists(folder));
    std::filesystem::create_directories(folder / "results.csv");
    const auto taken = checkReportFolder(folder);
    ASSERT_FALSE(taken);
    EXPECT_THAT(taken.error().message(), HasSubstr("results.csv: is a folder"));
    std::filesystem::remove_all(folder);
}

TEST_F(Report, ShowsChosenWindowsOnceAndLeavesOutUnknownOnes) {
    context_.chosen = {0, 0, 9999};
    const std::string html = reportHtml(evaluation_, context_);
    const std::size_t first = html.find("hosen");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(html.find("hosen", first + 1), std::string::npos);
}

TEST_F(Report, StandsAlsoForRobotsThatOnlyDriveStraightOrOnlyTurn) {
    for (const Command command : {Command{0.2, 0}, Command{0, 0.5}}) {
        const Log log = logOf({obedientTrajectory(0, 40 * second, [&](double) { return command; })});
        const NamedModel model = NamedModel::same("m", right_);
        const auto evaluation = evaluate(log, {&model, 1});
        ASSERT_TRUE(evaluation);
        EXPECT_EQ(markupError(reportHtml(*evaluation, {})), "");
        EXPECT_THAT(resultsJson(*evaluation, {}), HasSubstr("null"));
    }
}

TEST_F(Report, FilesAreWrittenTogether) {
    const auto folder = std::filesystem::temp_directory_path() / ("mrose_report_" + std::to_string(getpid()));
    ASSERT_TRUE(writeReport(evaluation_, context_, folder / "deep"));
    EXPECT_EQ(*readFile(folder / "deep/report.html"), reportHtml(evaluation_, context_));
    EXPECT_EQ(*readFile(folder / "deep/results.csv"), resultsCsv(evaluation_));
    EXPECT_EQ(*readFile(folder / "deep/results.json"), resultsJson(evaluation_, context_));
    std::filesystem::remove_all(folder);
}

TEST_F(Report, UnwritableFolderIsNamed) {
    const auto file = std::filesystem::temp_directory_path() / ("mrose_file_" + std::to_string(getpid()));
    std::ofstream(file) << "in the way";
    const auto written = writeReport(evaluation_, context_, file / "report");
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().message(), HasSubstr(file.string()));
    std::filesystem::remove(file);
    EXPECT_FALSE(writeReport({}, context_, file));
}

TEST_F(Report, JsonAndCsvHoldWhatWasMeasured) {
    const auto json = nlohmann::json::parse(resultsJson(evaluation_, context_));
    ASSERT_EQ(json["models"].size(), 2u);
    EXPECT_EQ(json["models"][1]["name"], "fast, too");
    EXPECT_EQ(json["models"][1]["all"]["P_percent"].get<double>(), evaluation_.models[1].all.p);
    EXPECT_EQ(json["windows"].size(), evaluation_.log.windows.size());
    EXPECT_EQ(json["windows"][2]["errors_by_model"][1]["position_final_m"].get<double>(),
              evaluation_.models[1].errors[2].positionFinal);
    EXPECT_EQ(json["log"]["files"][0]["xxh3"], "00ff00ff00ff00ff");
    EXPECT_EQ(json["floor"]["pair_count"].get<std::size_t>(), evaluation_.log.floor->pairs.size());

    const std::string csv = resultsCsv(evaluation_);
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
              1 + 2 * evaluation_.log.windows.size());
    EXPECT_THAT(csv, HasSubstr("\n\"fast, too\",1,0,r<2>,a,3.5,"));
}

TEST_F(Report, ResultsTellSteadyWindowsAndBothPaths) {
    evaluation_.log.windows[1].steady = true;
    evaluation_.log.windows[1].pathBySteps += 0.5;
    const std::string csv = resultsCsv(evaluation_);
    const Window& w = evaluation_.log.windows[1];
    const auto cells = [&](const Window& window, const std::string& steady) {
        return ",r<2>,a," + secondsText(window.start) + "," + std::string(name(window.manoeuvre)) + "," + steady + "," +
               fixed(window.path, 6) + "," + fixed(window.pathBySteps, 6) + ",";
    };
    EXPECT_THAT(csv, HasSubstr(cells(evaluation_.log.windows[0], "0")));
    EXPECT_THAT(csv, HasSubstr(cells(w, "1")));
    const auto windows = nlohmann::json::parse(resultsJson(evaluation_, context_))["windows"];
    EXPECT_EQ(windows[0]["steady"], false);
    EXPECT_EQ(windows[1]["steady"], true);
    EXPECT_EQ(windows[1]["path_by_steps_m"].get<double>(), w.pathBySteps);
}

TEST(Escaped, ReplacesMarkupControlsAndBrokenUtf8) {
    EXPECT_EQ(escaped("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
    EXPECT_EQ(escaped("ü°–😀"), "ü°–😀");
    EXPECT_EQ(escaped(std::string_view("\x01\xff\xc3", 3)), "\uFFFD\uFFFD\uFFFD");
}

TEST(NiceTicks, AreRoundNumbersWithinTheRange) {
    const AxisTicks ticks = axisTicks({0, 10.3}, 5);
    EXPECT_EQ(ticks.values, (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(ticks.decimals, 0);
    const AxisTicks small = axisTicks({-0.012, 0.021}, 4);
    EXPECT_EQ(small.decimals, 2);
    EXPECT_EQ(small.values.size(), 4u);
    EXPECT_NEAR(small.values.front(), -0.01, 1e-15);
    EXPECT_FALSE(axisTicks({3, 3}, 5).values.empty());
    EXPECT_FALSE(axisTicks({std::nan(""), 1}, 5).values.empty());
}

TEST(SvgPlot, EqualScaleHasSquarePixelsAndContainsTheRanges) {
    SvgPlot plot = SvgPlot::equalScale({.width = 200, .height = 100, .left = 0, .right = 0, .top = 0, .bottom = 0},
                                       {0, 1}, {0, 1}, "");
    EXPECT_NEAR(plot.unitsPerPixel(), 0.01, 1e-15);
    const Point corners[] = {{0, 0}, {1, 1}, {std::nan(""), 0}};
    plot.line(corners, "x");
    EXPECT_THAT(plot.text(), HasSubstr("M50.00 100.00L150.00 0.00\""));
}

TEST(Evaluation, TellsHowFarItIsAndEndsWhenToldTo) {
    const Log log = logOf({obedientTrajectory(0, 120 * second, wandering)});
    const HeldCommandModel held(100'000'000);
    const std::vector models{NamedModel::same("a", held), NamedModel::same("b", held)};
    std::vector<double> shares;
    const auto note = [&](double share) {
        shares.push_back(share);
        return true;
    };
    ASSERT_TRUE(evaluate(log, models, {}, note));
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_EQ(shares.back(), 1);
    EXPECT_GT(shares.size(), 2 * models.size());
    for (std::size_t last = 1; last < shares.size(); ++last) {
        std::size_t asked = 0;
        const auto ended = evaluate(log, models, {}, [&](double) { return ++asked < last; });
        ASSERT_FALSE(ended);
        EXPECT_EQ(asked, last);
        EXPECT_EQ(ended.error().message(), "the evaluation was ended before its end");
    }
}

}  // namespace
}  // namespace mrose
