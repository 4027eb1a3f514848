#include "report/sensor_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assessment/sensor_queries.h"
#include "io/file.h"
#include "io/format.h"
#include "report/error_link_section.h"
#include "report/sensor_files.h"
#include "support/markup.h"
#include "support/temporary_folder.h"
#include "support/toy_camera.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::Not;

class SensorReport : public testing::Test {
protected:
    SensorReport() {
        Log log = seenLog(camera_, 300);
        log.source = "logs/<a> & \"b\"";
        log.dataset = 3;
        log.files = {{"logs/<file>", "00ff00ff00ff00ff"}};
        const NamedSensor models[] = {{"cam <b>", &camera_}, {"wide, too", &wide_}};
        evaluation_ = *evaluateSensors(log, *loggedCases(log, "camera", {}, {}), models);
        context_.program = "mrose <1>";
        context_.modelFacts = {{"kind<", "a & \"b\""}, {"command", "mrose train <x>"}};
        context_.trainingLogs = {{"train<ing>", "123456789abcdef0"}};
        context_.commandLine = "mrose evaluate 'x' > y";
    }

    const ToyCamera camera_, wide_{2};
    SensorEvaluation evaluation_;
    ReportContext context_;
};

TEST_F(SensorReport, IsWellFormedAndEscapesAllText) {
    const std::string html = sensorReportHtml(evaluation_, context_);
    EXPECT_EQ(markupError(html), "");
    for (const char* raw : {"cam <b>", "<a> &", "<file>", "train<ing>", "kind<\"", "mrose <1>"})
        EXPECT_THAT(html, Not(HasSubstr(raw)));
    for (const char* text : {"<code>mrose train &lt;x&gt;</code>", "cam &lt;b&gt;",
                             "logs/&lt;a&gt; &amp; &quot;b&quot;", "123456789abcdef0", "&#39;x&#39; &gt; y"})
        EXPECT_THAT(html, HasSubstr(text));
}

TEST_F(SensorReport, HoldsTheFiguresAndThePictures) {
    const std::string html = sensorReportHtml(evaluation_, context_);
    const SensorScores& all = evaluation_.models[0].all;
    EXPECT_THAT(html, HasSubstr(fixed(100 * all.error[0].crps, 2) + " <small>cm"));
    EXPECT_THAT(html, HasSubstr(fixed(1000 * all.error[1].crps, 2) + " <small>mrad"));
    EXPECT_THAT(html, HasSubstr("<b>−" + fixed(-all.detection, 4) + "</b>"));
    EXPECT_THAT(html, HasSubstr(fixed(1000 * evaluation_.models[1].all.error[1].rmse, 2)));
    // one look, four of bands, two of detection, three of reliability, two of what lies below
    const std::size_t closeUps = countOf(html, "class=\"closeup\"");
    EXPECT_GT(closeUps, 1u);
    EXPECT_EQ(countOf(html, "<svg class=\"plot\""), 12 + closeUps);
    EXPECT_THAT(html, HasSubstr("(less is better)"));
    for (const char* link : {"<script", "src=", "href=\"http", "url(http", "@import", "<link", "nan", "inf<"})
        EXPECT_THAT(html, Not(HasSubstr(link)));
}

TEST_F(SensorReport, SaysSyntheticWhereTheLogIs) {
    EXPECT_THAT(sensorReportHtml(evaluation_, context_), Not(HasSubstr("simulated robot")));
    evaluation_.log.synthetic = true;
    const std::string html = sensorReportHtml(evaluation_, context_);
    EXPECT_THAT(html, HasSubstr("simulated robot"));
    EXPECT_THAT(html, HasSubstr("<h3>Logged</h3>"));
}

TEST_F(SensorReport, CorrelationsAreThoseOfEachOfSeveralRobotsToo) {
    ASSERT_EQ(evaluation_.log.robots.size(), 1u);
    EXPECT_THAT(errorLinkSection(evaluation_), Not(HasSubstr("bearing, robot")));
    evaluation_.log.robots.push_back(evaluation_.log.robots[0]);
    evaluation_.log.robots[1].name = "<2>";
    evaluation_.linksByRobot.push_back(evaluation_.linksByRobot[0]);
    evaluation_.linksByRobot[1][1].next = {77, 0.6180, 0.5};
    const std::string html = errorLinkSection(evaluation_);
    EXPECT_EQ(markupError(html), "");
    EXPECT_THAT(html, HasSubstr("bearing, robot 1"));
    EXPECT_THAT(html, HasSubstr("bearing, robot &lt;2&gt;</th><td>0.62</td><td>0.50</td><td>77</td>"));
}

TEST_F(SensorReport, WritesAllFilesWithTheSameFigures) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "made" / "report";
    ASSERT_TRUE(writeSensorReport(evaluation_, context_, path));
    const auto again = checkSensorReportFolder(path, false);
    ASSERT_FALSE(again);
    EXPECT_THAT(again.error().message(), HasSubstr("results.csv"));
    const auto json = nlohmann::json::parse(*readFile(path / "results.json"));
    const SensorScores& all = evaluation_.models[0].all;
    EXPECT_EQ(json["models"][0]["all"]["range"]["crps_m"], all.error[0].crps);
    EXPECT_EQ(json["models"][1]["robots"][0]["robot"], "1");
    const auto& links = json["errors_in_common"]["correlations"]["range"];
    EXPECT_EQ(links["robots"][0]["same_subject_next_look"], links["same_subject_next_look"]) << "there is one robot";
    EXPECT_EQ(json["models"][0]["all"]["calibration"].size(), calibrationGroups);
    EXPECT_THAT(*readFile(path / "results.csv"),
                HasSubstr("\"wide, too\",all," + std::to_string(all.cases) + "," + std::to_string(all.readings)));
    EXPECT_EQ(*readFile(path / "report.html"), sensorReportHtml(evaluation_, context_));
}

TEST_F(SensorReport, ItsCasesAreQueries) {
    const auto queries = parseQueries(sensorCasesCsv(evaluation_), "cases.csv");
    ASSERT_TRUE(queries) << queries.error().message();
    ASSERT_EQ(queries->size(), evaluation_.log.cases.size());
    EXPECT_EQ(queries->front().dataset, 3);
    EXPECT_EQ(queries->front().robot, "1");
    EXPECT_EQ(queries->front().time, evaluation_.log.looks.front().time);
    EXPECT_EQ(queries->front().subject, evaluation_.log.subjects[evaluation_.log.cases.front().subject]);
}

}  // namespace
}  // namespace mrose
