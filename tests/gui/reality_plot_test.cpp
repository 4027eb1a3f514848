// Numbers of reality: in plots, in the inspector and on the timeline.
#include <QApplication>
#include <QTreeWidget>
#include <cmath>
#include <numbers>

#include "gui/reality_fixture.h"
#include "gui/window_fixture.h"
#include "panels/plot_panel.h"
#include "reality/run_timeline.h"
#include "simulation/step.h"
#include "widgets/field_fixture.h"
#include "widgets/inspector_rows.h"

namespace mrose::gui {
namespace {

constexpr double degree = std::numbers::pi / 180;
const RealDrive ahead{"a", {-3, -2, 0}, {0.5, 0}, {{5.0, 6.0}}};
const RealDrive aside{"b", {1, 1, 0.5}, {0.3, 0}};

/// A window with two robots that play a log, from 1 s of it on, half as fast.
class RealityPlotTest : public testing::Test {
protected:
    RealityPlotTest() : run(overlaidRun(logOfDrives({ahead, aside}, 12), 1, 10, 0.5)) {
        window.show(run);
        window.QWidget::show();
        settle();
    }
    void settle() {
        window.session().settle();
        QApplication::processEvents();
    }
    void settlePlots() {
        settle();
        window.plots().settle();
        QApplication::processEvents();
    }
    void seek(std::int64_t tick) {
        window.session().seek(tick);
        settle();
    }
    const PlotCurve& curve(const QString& name) {
        for (const PlotCurve& curve : window.plots().view().curves())
            if (curve.name == name) return curve;
        ADD_FAILURE() << "no curve " << name.toStdString();
        static const PlotCurve none{};
        return none;
    }
    /// Another one beside the run, with two models that stand at fixed places.
    Reality withModels() const {
        Reality reality = *run.reality;
        for (int m = 0; m < 2; ++m) {
            const std::vector<Pose> still(600, Pose{-2.0 + m, 0, 30 * degree});
            reality.models.push_back({m == 0 ? "first" : "second", 20'000'000, {still, still}});
        }
        return reality;
    }
    void setReality(Reality reality) {
        window.session().setReality(window.shown()->run, std::make_shared<const Reality>(std::move(reality)));
        settle();
    }

    OpenedRun run;
    MainWindow window;
};

TEST_F(RealityPlotTest, NumbersAreThoseOfTheTruthAtEveryTick) {
    seek(400);
    for (const char* quantity :
         {"error", "heading_error", "real_x", "real_heading", "real_v", "error_ahead", "error_left"})
        for (const char* body : {"sim a", "sim b"}) ASSERT_TRUE(window.plots().add({quantity, body}));
    settlePlots();
    const Scenario& scenario = *run.setup->scenario;
    WorldState state = run.start;
    StepBuffers buffers;
    int unknown = 0;
    for (std::int64_t tick = 0; tick <= 400; ++tick) {
        const double now = 1 + 0.02 * static_cast<double>(tick);
        for (std::size_t i = 0; i < 2; ++i) {
            const RealDrive& drive = i == 0 ? ahead : aside;
            const Pose real = drive.poseAt(now), simulated = state.robots[i].pose;
            const bool known = i == 1 || now <= 5 + 1e-9 || now >= 6 + 1e-9;
            unknown += known ? 0 : 1;
            const QString body = i == 0 ? "sim a  " : "sim b  ";
            const auto expect = [&](const char* name, double expected) {
                const double plotted = curve(body + name).at(tick);
                if (known)
                    ASSERT_NEAR(plotted, expected, 1e-4) << name << " at " << tick;
                else
                    ASSERT_TRUE(std::isnan(plotted)) << name << " at " << tick;
            };
            const double x = simulated.x - real.x, y = simulated.y - real.y;
            const double c = std::cos(real.heading), s = std::sin(real.heading);
            expect("error", 100 * std::sqrt(x * x + y * y));
            expect("heading_error", std::abs(simulated.heading - real.heading) / degree);
            expect("error_ahead", 100 * (c * x + s * y));
            expect("error_left", 100 * (c * y - s * x));
            expect("real_x", real.x);
            expect("real_heading", real.heading / degree);
            // The slope is that of the poses about it: none next to the gap.
            if (std::abs(now - 5.5) > 0.6) expect("real_v", drive.command.v);
        }
        step(scenario, state, buffers);
    }
    EXPECT_EQ(unknown, 50);
    EXPECT_LT(curve("sim a  error_ahead").at(300), -100) << "half as fast: it is behind";
    EXPECT_EQ(curve("sim a  error").unit, "cm");
}

TEST_F(RealityPlotTest, AnotherRealityMakesOtherNumbers) {
    seek(150);
    ASSERT_TRUE(window.plots().add({"error", "sim b"}));
    ASSERT_TRUE(window.plots().add({"speed", "sim b"}));
    settlePlots();
    const double before = curve("sim b  error").at(100);
    Reality later = *run.reality;
    for (Reality::Robot& robot : later.robots) robot.origin += nanosecondsPerSecond;
    setReality(later);
    settlePlots();
    // A second later the real one is 0.3 m farther on.
    EXPECT_NEAR(curve("sim b  error").at(100), before + 30, 1e-3);
    window.session().setReality(window.shown()->run, nullptr);
    settlePlots();
    EXPECT_TRUE(std::isnan(curve("sim b  error").at(100)));
    EXPECT_FALSE(std::isnan(curve("sim b  speed").at(100)));
    // One for a run that is open no more changes nothing.
    window.session().setReality(window.shown()->run + 1, run.reality);
    settlePlots();
    EXPECT_EQ(window.shown()->frame->reality, nullptr);
}

TEST_F(RealityPlotTest, OneKeyPlotsTheErrorsOfRunAndModels) {
    setReality(withModels());
    seek(100);
    window.field().setSelected(0);
    QTest::keyClick(&window, Qt::Key_R, Qt::ShiftModifier);
    settlePlots();
    ASSERT_EQ(window.plots().keys().size(), 6u);
    EXPECT_NEAR(curve("sim a  first: error").at(100), 100 * std::hypot(-2 - ahead.poseAt(3).x, -ahead.poseAt(3).y),
                1e-3);
    EXPECT_NEAR(curve("sim a  second: heading_error").at(100), 30, 1e-4);
    const auto colours = window.plots().plotted();
    EXPECT_EQ(colours.at({"model_error", "sim a", "first"}), modelColour(0));
    EXPECT_EQ(colours.at({"model_error", "sim a", "second"}), modelColour(1));
    EXPECT_EQ(curve("sim a  second: heading_error").style, modelStyle(1));
    QTest::keyClick(&window, Qt::Key_R, Qt::ShiftModifier);
    EXPECT_TRUE(window.plots().keys().empty());
    window.field().setSelected(std::nullopt);
    QTest::keyClick(&window, Qt::Key_R, Qt::ShiftModifier);
    EXPECT_EQ(window.plots().keys().size(), 12u) << "of both robots";
    ASSERT_TRUE(window.open("soccer.toml"));
    settle();
    QTest::keyClick(&window, Qt::Key_R, Qt::ShiftModifier);
    EXPECT_TRUE(window.plots().keys().empty()) << "nothing real is known of it";
}

TEST_F(RealityPlotTest, InspectorTellsOfTheRealRobot) {
    setReality(withModels());
    const auto row = [&](const QString& name) {
        const auto rows = inspectorRows(*window.shown()->frame, 0, [](const QString&) { return true; });
        for (const InspectorRow& section : rows)
            if (section.name == "Reality")
                for (const InspectorRow& one : section.children)
                    if (one.name == name) return one;
        return InspectorRow{};
    };
    seek(100);
    const double error = 100 * (ahead.poseAt(3).x - window.shown()->frame->poseOf(0).x);
    EXPECT_EQ(row("error").value, QString::number(error, 'f', 1));
    EXPECT_EQ(row("error").unit, "cm");
    EXPECT_EQ(row("error_ahead").value, QString::number(-error, 'f', 1));
    EXPECT_EQ(row("real_x").value, "-1.500");
    EXPECT_EQ(row("real_v").value, "0.500");
    EXPECT_EQ(row("first").value, QString::number(100 * std::hypot(0.5, 2), 'f', 1));
    ASSERT_TRUE(row("first").plot);
    EXPECT_EQ(*row("first").plot, (ValueKey{"model_error", "sim a", "first"}));
    EXPECT_EQ(row("Ground truth").value, QString());
    seek(220);  // 5.4 s
    EXPECT_EQ(row("Ground truth").value, "none for 0.4 s");
    EXPECT_TRUE(row("error").quiet);
    EXPECT_EQ(row("error").unit, "") << "nothing has no unit";
}

TEST_F(RealityPlotTest, TimelineShowsUnknownStretchesAndNotes) {
    const double tick = 0.02;
    const auto unknown = [](const Reality& reality, const Reality::Robot* robot) {
        std::vector<std::pair<double, double>> seconds;
        for (const auto& [from, to] : reality.unknownOf(robot)) seconds.emplace_back(toSeconds(from), toSeconds(to));
        if (!seconds.empty()) seconds.pop_back();  // after the log
        return seconds;
    };
    EXPECT_EQ(unknown(*run.reality, &run.reality->robots[0]), (std::vector<std::pair<double, double>>{{4, 5}}));
    EXPECT_TRUE(unknown(*run.reality, nullptr).empty()) << "the other one was seen all the time";
    seek(100);
    window.field().setSelected(0);
    const auto says = [&](double seconds) {
        TimelineBar& bar = window.timeline();
        return bar.textAt(bar.pixelOf(static_cast<std::int64_t>(seconds / tick)));
    };
    EXPECT_TRUE(says(4.5).contains("no ground truth"));
    EXPECT_FALSE(says(3.5).contains("no ground truth"));
    window.field().setSelected(1);
    EXPECT_FALSE(says(4.5).contains("no ground truth"));
    window.runTimeline().note({{{170, TimelineMark::Kind::divergence, 0, noBody}, "sim a, 12 cm"}});
    EXPECT_TRUE(says(3.4).contains("first divergence: sim a, 12 cm")) << says(3.4).toStdString();
    seek(400);
    QTest::keyClick(&window, Qt::Key_Comma);
    settle();
    EXPECT_EQ(window.shown()->tick(), 170);
    window.show(run);
    settle();
    EXPECT_FALSE(says(3.4).contains("first divergence")) << "of another run";
}

TEST_F(RealityPlotTest, PlotsShowTheBoundAndTheInstantBeyondIt) {
    window.frame().showDock("plots");
    seek(400);
    ASSERT_TRUE(window.plots().add({"error", "sim b"}));
    settlePlots();
    PlotView& view = window.plots().view();
    const QColor colour = markColour(TimelineMark::Kind::divergence, Theme::light());
    view.draw();
    EXPECT_EQ(blobOf(rendered(view), colour, 8).pixels, 0);
    view.setReferences({{"cm", {{0, 60}}}, {"m", {{0, 1}}}}, 200);
    view.draw();
    const QImage picture = rendered(view);
    const QPointF crossing = *view.placeOf(view.curves().front().id, 200, 60);
    int across = 0, down = 0;
    for (int d = -30; d <= 30; ++d) {
        const auto is = [&](const QPointF& at) {
            return blobOf(picture.copy(QRect(at.toPoint() - QPoint(1, 1), QSize(3, 3))), colour, 100).pixels > 0;
        };
        across += is(crossing + QPointF(d, 0)) ? 1 : 0;
        down += is(crossing + QPointF(0, d)) ? 1 : 0;
    }
    EXPECT_GT(across, 25) << "dashed";
    EXPECT_GT(down, 55) << "solid";
}

}  // namespace
}  // namespace mrose::gui
