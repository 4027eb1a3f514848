#include "report/comparison_report.h"

#include <regex>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assessment/played_scenarios.h"
#include "assessment/test_models.h"
#include "io/file.h"
#include "io/format.h"
#include "report/comparison_files.h"
#include "sensing/odometry.h"
#include "support/markup.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

/// A robot with a name that must be escaped, with a gap in its ground truth, and its scene.
struct Compared {
    Log log;
    Comparison comparison;
    Scene scene;

    explicit Compared(std::optional<Nanoseconds> every) {
        log = logOf({obedientTrajectory(0, 40 * second, [](double t) { return Command{0.2, 0.2 * std::sin(t)}; })});
        std::erase_if(log.robots[0].trajectories[0].poses,
                      [](const StampedPose& pose) { return pose.time > 12 * second && pose.time < 15 * second; });
        ScenarioParts parts = playersOf(log, std::make_shared<const HeldCommandModel>(100'000'000, 1.2));
        parts.scene.robots[0].name = "a <b> & \"c\", d";
        scene = parts.scene;
        const auto world = LogWorld::create(std::move(parts), std::make_shared<const Log>(log));
        const auto requests = rolloutsOf(*world, {second, std::nullopt, every});
        comparison = *compare(*world, *requests);
    }
    std::string html() const { return comparisonHtml(comparison, scene, {.program = "p", .commandLine = "c"}); }
};

TEST(ComparisonReport, NeedsNothingElseAndShowsEveryRolloutThatIsAsked) {
    for (const std::optional<Nanoseconds> every : {std::optional<Nanoseconds>{}, std::optional(3 * second)}) {
        const Compared compared(every);
        const std::string html = compared.html();
        EXPECT_EQ(markupError(html), "");
        EXPECT_EQ(html.find("src="), std::string::npos);
        EXPECT_EQ(html.find("http"), html.find("http://www.w3.org/2000/svg")) << "a name, no address";
        EXPECT_EQ(html.find("<b> & "), std::string::npos);
        EXPECT_NE(html.find("a &lt;b&gt; &amp; &quot;c&quot;"), std::string::npos);
        for (const char* undefined : {"nan", "inf<"}) EXPECT_EQ(html.find(undefined), std::string::npos) << undefined;
        EXPECT_EQ(countOf(html, "aria-label=\"Real and predicted path\""), every ? 5u : 1u);
        EXPECT_EQ(countOf(html, "The worst rollouts"), every ? 1u : 0u);
        EXPECT_NE(html.find("with a gap in the ground truth"), std::string::npos);
    }
}

/// Looks of 200 s: everything is reported, a little too far.
LookStreams someLooks() {
    LookStreams looks;
    for (int i = 0; i < 100; ++i) {
        const SensedSubject subject{0, 1 + 0.02 * i, 0.1, true, i % 3 > 0, 0.01 * (i % 7), 0.002 * (i % 5)};
        looks.real.push_back({0, 0, 2 * i * second, {subject}});
        looks.simulated.push_back({0, 0, (2 * i + 1) * second, {subject}});
    }
    return looks;
}

TEST(ComparisonReport, SaysWhatSensorsReported) {
    Compared compared(std::nullopt);
    EXPECT_EQ(compared.html().find("What the sensor"), std::string::npos);
    const SensorPair pair{"a <b>", {std::make_shared<const Odometry>(0, 0)}, {4, 1.2, 0}};
    compared.comparison.subjects = {"6"};
    compared.comparison.sensors = {compareStreams(pair, someLooks(), compared.comparison.requests),
                                   compareStreams(pair, {}, compared.comparison.requests)};
    const std::string html = compared.html();
    EXPECT_EQ(markupError(html), "");
    EXPECT_NE(html.find("a &lt;b&gt;"), std::string::npos);
    EXPECT_EQ(countOf(html, "aria-label=\"Share of subjects reported"), 2u);
    EXPECT_EQ(countOf(html, "aria-label=\"Distribution of "), 2u) << "not of the one that had nothing in view";
    EXPECT_NE(html.find("that the log and the simulated world both know"), std::string::npos);
    for (const char* undefined : {"nan", "inf<"}) EXPECT_EQ(html.find(undefined), std::string::npos) << undefined;

    const TemporaryFolder folder;
    const std::filesystem::path place = folder.path() / "report";
    ASSERT_TRUE(writeComparison(compared.comparison, compared.scene, {}, place));
    EXPECT_TRUE(std::filesystem::exists(place / "readings.csv"));
    const auto json = nlohmann::json::parse(comparisonJson(compared.comparison, {}));
    const auto& all = json["sensors"][0]["all"];
    EXPECT_EQ(all["looks"]["real"], 100);
    EXPECT_NEAR(all["reported"]["simulated"]["share"].get<double>(), 0.66, 1e-12);
    EXPECT_EQ(all["range_error_m"]["test"]["statistic"], 0);
    EXPECT_EQ(all["range_error_m"]["test"]["p"], 1);
    EXPECT_TRUE(json["sensors"][1]["all"]["reported"]["real"]["share"].is_null());
}

TEST(ComparisonReport, PathsAreInterruptedWhereTheTruthIsNotKnown) {
    const std::string html = Compared(std::nullopt).html();
    const std::string figure = html.substr(html.find("Real and predicted path"));
    const auto piecesOf = [&](const char* line) {
        const std::string upTo = figure.substr(0, figure.find(line));
        return countOf(upTo.substr(upTo.rfind("<path")), "M");
    };
    EXPECT_EQ(piecesOf("class=\"line real\""), 2u);
    EXPECT_EQ(piecesOf("class=\"line s0\""), 1u);
}

/// The robot is in no ground truth at the second rollout's start: the picture of that rollout says so.
TEST(ComparisonReport, SaysWhoIsAbsent) {
    Log log = logOf({obedientTrajectory(0, 40 * second, [](double) { return Command{0.2, 0.1}; })});
    log.robots.push_back(log.robots[0]);
    log.robots[1].robot = "other";
    for (StampedPose& pose : log.robots[1].trajectories[0].poses) pose.pose.y += 3;
    std::erase_if(log.robots[1].trajectories[0].poses, [](const StampedPose& pose) { return pose.time > 10 * second; });
    ScenarioParts parts = playersOf(log, std::make_shared<const HeldCommandModel>(100'000'000, 1.2));
    parts.scene.robots[1].name = "a <b>";
    const Scene scene = parts.scene;
    const auto world = LogWorld::create(std::move(parts), std::make_shared<const Log>(log));
    ASSERT_TRUE(world) << world.error().message();
    for (const Nanoseconds start : {second, 20 * second}) {
        const auto requests = rolloutsOf(*world, {start, 5 * second, std::nullopt});
        const Comparison comparison = *compare(*world, *requests);
        const std::string html = comparisonHtml(comparison, scene, {.program = "p", .commandLine = "c"});
        const bool absent = start > 10 * second;
        EXPECT_EQ(markupError(html), "");
        EXPECT_EQ(countOf(html, "; no ground truth then of a &lt;b&gt;</text>"), absent ? 1u : 0u);
        EXPECT_EQ(countOf(html, "<b>a &lt;b&gt;</b> is not in this rollout"), absent ? 1u : 0u);
        EXPECT_EQ(countOf(html, "fill=\"#222222\">a &lt;b&gt;</text>"), absent ? 0u : 1u) << "beside its start";
    }
}

TEST(ComparisonReport, RanksTheWorstRolloutsAndSaysWhatDoesNotCount) {
    const Compared compared(3 * second);
    const std::string html = compared.html();
    const std::size_t begin = html.find("The worst rollouts");
    const std::string table = html.substr(begin, html.find("</table>", begin) - begin);
    EXPECT_NE(table.find("mean cm ▼"), std::string::npos);
    const std::size_t worst = worstFirst(compared.comparison).front();
    EXPECT_NE(table.find("<th scope=\"row\">1</th><td>a &lt;b&gt; &amp; &quot;c&quot;, d</td><td>" +
                         std::to_string(compared.comparison.rollouts[worst].request + 1) + "</td>"),
              std::string::npos);
    EXPECT_GT(countOf(table, "not in P and Hd: gap in the ground truth"), 0u);
    EXPECT_EQ(countOf(table, "–"), 0u) << "a dash explains nothing";
    EXPECT_EQ(countOf(table, "<b></b>"), 0u) << "what it is sorted by is known of all";
    EXPECT_EQ(countOf(html, "mean –"), 0u);
    const double end = compared.comparison.all.counted.positionFinal.median;
    EXPECT_NE(html.find("(median) it is " + fixed(100 * end, 1) + "\u00a0cm off"), std::string::npos)
        << "sentence and tiles are of the same rollouts";
}

/// With a robot that is 20 % too fast: it leaves the real trajectory, in the page, the table and the JSON alike.
TEST(ComparisonReport, ShowsWhereTheRobotsLeaveTheRealTrajectoryAndWhy) {
    const Log log = logOf({obedientTrajectory(0, 40 * second, [](double t) {
        return Command{0.2, 0.2 * std::sin(t)};
    })});
    for (const bool many : {false, true}) {
        ScenarioParts parts = playersOf(log, std::make_shared<const HeldCommandModel>(100'000'000, 1.2));
        parts.scene.robots[0].name = "a <b>";
        const Scene scene = parts.scene;
        const auto world = LogWorld::create(std::move(parts), std::make_shared<const Log>(log));
        const auto requests =
            rolloutsOf(*world, {second, std::nullopt, many ? std::optional(8 * second) : std::nullopt});
        const Comparison comparison = *compare(*world, *requests);
        DivergenceOptions options;
        options.models = {{"right.net", {std::make_shared<const HeldCommandModel>()}}};
        options.diagnosed = 3;
        const auto found = divergencesOf(*world, comparison, options);
        ASSERT_TRUE(found) << found.error().message();
        ASSERT_EQ(found->all.diverging, comparison.rollouts.size());
        const std::size_t diagnosed = many ? 3 : 1;
        const Divergence& first = found->rollouts.front().divergence;
        EXPECT_NEAR(toSeconds(first.time), 0.1 / 0.04, 0.15) << "0.04 m/s too fast";

        const std::string html = comparisonHtml(comparison, scene, {.program = "p", .commandLine = "c"}, &*found);
        EXPECT_EQ(markupError(html), "");
        for (const char* undefined : {"nan", "inf<"}) EXPECT_EQ(html.find(undefined), std::string::npos) << undefined;
        EXPECT_EQ(countOf(html, "Likely cause: motion model right.net, which explains "), diagnosed);
        EXPECT_EQ(countOf(html, "<b>motion model right.net</b>"), diagnosed);
        EXPECT_NE(html.find("off by more than 10.0 cm or 10.0° for 0.3 s."), std::string::npos);
        EXPECT_EQ(countOf(html, "It leaves the real trajectory after "), diagnosed);
        // A ring in each legend and robot's picture, in the error plots of a single rollout alone.
        const std::size_t pictures = countOf(html, "aria-label=\"Real and predicted path\"");
        EXPECT_EQ(countOf(html, "class=\"leaves\""), 1 + pictures + (many ? 0 : 2))
            << "in the plot of positions, and its legend";
        EXPECT_EQ(countOf(html, ">bound</text>"), 1u) << "of the positions; headings stay far below theirs";
        EXPECT_EQ(countOf(comparisonHtml(comparison, scene, {}), "leaves the real trajectory"), 0u);

        const auto json = nlohmann::json::parse(comparisonJson(comparison, {}, &*found))["divergence"];
        EXPECT_EQ(json["all"]["diverging"], comparison.rollouts.size());
        EXPECT_EQ(json["all"]["median_s"], found->all.medianTime);
        EXPECT_EQ(json["bound"]["position_m"], 0.1);
        EXPECT_EQ(json["rollouts"][0]["time_s"], toSeconds(first.time));
        EXPECT_EQ(json["rollouts"][0]["position_m"], first.position);
        std::size_t causes = 0;
        for (const auto& rollout : json["rollouts"]) {
            if (!rollout.contains("cause")) continue;
            ++causes;
            EXPECT_EQ(rollout["cause"]["what"], "motion model right.net");
            EXPECT_EQ(rollout["cause"], rollout["tried"][0]);
        }
        EXPECT_EQ(causes, diagnosed);
        EXPECT_EQ(countOf(rolloutsCsv(comparison, &*found), ",motion model right.net\n"), diagnosed);
    }
}

TEST(ComparisonReport, CsvQuotesNamesAndLeavesUnknownCellsEmpty) {
    const Compared compared(std::nullopt);
    const std::string csv = errorsCsv(compared.comparison);
    EXPECT_NE(csv.find("\n0,r,1.0,0.1,"), std::string::npos);
    EXPECT_NE(csv.find(",\"a <b> & \"\"c\"\", d\"\n"), std::string::npos);
    // From 12 s to 15 s of the log, which are 11 to 14 s of the rollout; the ends' instants lie in no gap or end it.
    EXPECT_EQ(countOf(csv, ",,,,,,\""), 30u);
}

TEST(ComparisonReport, FilesAreWrittenTogether) {
    const Compared compared(3 * second);
    const TemporaryFolder folder;
    const auto to = folder.path() / "new" / "report";
    ASSERT_TRUE(checkComparisonFolder(to));
    ASSERT_TRUE(writeComparison(compared.comparison, compared.scene, {}, to));
    for (const char* file : {"report.html", "errors.csv", "rollouts.csv", "results.json"})
        EXPECT_TRUE(readFile(to / file)) << file;
    EXPECT_FALSE(checkComparisonFolder(folder.write("taken", "x")));
}

}  // namespace
}  // namespace mrose
