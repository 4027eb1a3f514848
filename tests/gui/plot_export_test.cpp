// Plots as pictures, and what is plotted as numbers.
#include "export/plot_export.h"

#include <QApplication>
#include <QRegularExpression>
#include <QXmlStreamReader>
#include <cmath>
#include <sstream>

#include <gmock/gmock.h>

#include "gui/export_fixture.h"
#include "io/format.h"
#include "panels/plot_panel.h"
#include "session/background_work.h"
#include "simulation/step.h"
#include "support/full_disk.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

class PlotExportTest : public ExportTest {
protected:
    void plot(const ValueKey& key) { ASSERT_TRUE(window.plots().add(key)); }
    static std::vector<std::vector<std::string>> rowsOf(const std::string& csv) {
        std::vector<std::vector<std::string>> rows;
        std::istringstream lines(csv);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream cells(line);
            rows.emplace_back();
            for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
            if (line.ends_with(',')) rows.back().emplace_back();
        }
        return rows;
    }
    static double speedOf(const RobotState& robot) { return length({robot.velocity_B.x, robot.velocity_B.y}); }
};

/// Of another run, stepped by core alone.
TEST_F(PlotExportTest, TableHasTheVeryNumbersOfBothBranches) {
    seek(80);
    drag(pixelOf(0), pixelOf(0) + QPointF(50, 30));
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    const WorldState changed = state();
    seek(120);
    plot({"x", "red 1"});
    plot({"speed", "red 2"});
    plot({"note", "red 1", "distance"});
    ASSERT_TRUE(window.plots().addExpression("distance(robot[1], ball) * 2"));
    ASSERT_EQ(perform("export_values", path("values.csv")), "");
    const auto rows = rowsOf(read("values.csv"));
    ASSERT_EQ(rows.size(), 122u);
    ASSERT_EQ(rows[0].size(), 2u + 2 * 4 + 2) << "the expression's comma parts a quoted cell in two, twice";
    EXPECT_EQ(rows[0][0] + ' ' + rows[0][1], "time_s tick");
    EXPECT_EQ(rows[0][2], "red 1 x (m)");
    EXPECT_EQ(rows[0][3], "red 2 speed (m/s)");
    EXPECT_THAT(rows[0][7], HasSubstr("red 1 x (m) [the run]"));
    const Scenario& scenario = *window.shown()->frame->scenario;
    StepBuffers buffers;
    WorldState run = scenario.initialState(), branch = run;
    for (std::int64_t tick = 0; tick <= 120; ++tick) {
        const auto& row = rows[static_cast<std::size_t>(tick) + 1];
        ASSERT_EQ(row.size(), 10u) << tick;
        EXPECT_DOUBLE_EQ(std::stod(row[0]), 0.02 * static_cast<double>(tick));
        EXPECT_EQ(row[1], std::to_string(tick));
        if (tick == 80) branch = changed;
        const auto expect = [&](std::size_t column, const WorldState& at) {
            const Pose& red = at.robots[0].pose;
            const Pose& ball = at.objects[0].pose;
            EXPECT_EQ(row[column], numberText(red.x)) << tick;
            EXPECT_EQ(row[column + 1], numberText(speedOf(at.robots[1]))) << tick;
            EXPECT_NEAR(std::stod(row[column + 3]), 2 * std::hypot(red.x - ball.x, red.y - ball.y), 1e-12) << tick;
        };
        expect(2, branch);
        expect(6, run);
        EXPECT_EQ(row[4].empty(), tick == 0) << "no decision is known at the start";
        step(scenario, run, buffers);
        step(scenario, branch, buffers);
    }
}

TEST_F(PlotExportTest, PicturesHaveLegendAndAxesWithUnits) {
    seek(150);
    plot({"x", "red 1"});
    plot({"speed", "red 2"});
    window.setTheme(Theme::darkOne());
    ASSERT_EQ(perform("export_plots", path("plots.svg")), "");
    QXmlStreamReader xml(QByteArray::fromStdString(read("plots.svg")));
    QStringList texts;
    while (!xml.atEnd()) {
        xml.readNext();
        if (xml.isCharacters() && !xml.isWhitespace()) texts << xml.text().toString().trimmed();
    }
    EXPECT_FALSE(xml.hasError()) << xml.errorString().toStdString();
    for (const char* text : {"soccer", "red 1", "x (m)", "red 2", "speed (m/s)", "time (s)", "3"})
        EXPECT_TRUE(texts.contains(text)) << text;
    ASSERT_EQ(perform("export_plots", path("plots.pdf")), "");
    EXPECT_THAT(read("plots.pdf"), testing::StartsWith("%PDF-1."));
    ASSERT_EQ(perform("export_plots", path("plots.png")), "");
    const QImage picture(path("plots.png"));
    EXPECT_EQ(picture.width(), 2 * 7 * 96);
    EXPECT_EQ(picture.pixelColor(3, 3), QColor(Qt::white)) << "for paper, whatever the window's colours";
    // The curve's own colour is there, in the lines and in the legend.
    const QColor red = window.plots().curvesIn(Theme::light()).front().colour;
    int legend = 0, curve = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (picture.pixel(x, y) == red.rgb()) ++(y < 110 ? legend : curve);
    EXPECT_GT(legend, 20);
    EXPECT_GT(curve, 200);
}

TEST_F(PlotExportTest, BranchBesideIsInTheLegend) {
    seek(40);
    plot({"x", "red 1"});
    ASSERT_EQ(perform("export_plots", path("one.svg")), "");
    EXPECT_THAT(read("one.svg"), testing::Not(HasSubstr("the run")));
    drag(pixelOf(0), pixelOf(0) + QPointF(50, 30));
    ASSERT_EQ(perform("export_plots", path("two.svg")), "");
    EXPECT_THAT(read("two.svg"), HasSubstr("the run"));
}

TEST_F(PlotExportTest, WhatIsWrongIsOneLine) {
    EXPECT_THAT(perform("export_plots", path("a.pdf")), HasSubstr("nothing is plotted"));
    EXPECT_THAT(perform("export_values", path("a.csv")), HasSubstr("nothing is plotted"));
    seek(100);
    plot({"x", "red 1"});
    EXPECT_THAT(perform("export_plots", path("a.gif")), HasSubstr("a.gif: is no kind of picture"));
    EXPECT_THAT(perform("export_values", path("a.txt")), HasSubstr("a.txt: is no table"));
    EXPECT_THAT(perform("export_values", path("no/a.csv")), HasSubstr("a.csv: cannot be written: No such file"));
    folder.write("old.csv", "old");
    folder.write("old.pdf", "old");
    {
        const FullDisk disk(1000);
        EXPECT_THAT(perform("export_values", path("old.csv")), HasSubstr("old.csv: cannot be written: "));
        EXPECT_THAT(perform("export_plots", path("old.pdf")), HasSubstr("old.pdf: cannot be written: "));
    }
    EXPECT_EQ(read("old.csv") + read("old.pdf"), "oldold");
    EXPECT_EQ(files(), (std::vector<std::string>{"old.csv", "old.pdf"}));
}

TEST_F(PlotExportTest, CancelledTableLeavesNothing) {
    seek(2000);
    plot({"x", "red 1"});
    ASSERT_TRUE(exportValues(window.exports(), path("a.csv")));
    window.actions()["cancel"].trigger();
    finish();
    EXPECT_EQ(files(), std::vector<std::string>{});
    EXPECT_THAT(said(), testing::ElementsAre("Not exported: cancelled"));
}

}  // namespace
}  // namespace mrose::gui
