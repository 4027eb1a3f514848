#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QTimer>
#include <QWheelEvent>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <qcustomplot.h>

#include "gui/window_fixture.h"
#include "panels/plot_panel.h"
#include "support/values_at.h"
#include "widgets/curve_sampling.h"
#include "widgets/fixed_text.h"

namespace mrose::gui {
namespace {

class PlotTest : public WindowTest {
protected:
    PlotPanel& plots() { return window.plots(); }
    PlotView& view() { return plots().view(); }
    QCustomPlot& canvas() { return *view().findChild<QCustomPlot*>(); }
    const Scenario& scenario() const { return *window.shown()->frame->scenario; }

    void seek(std::int64_t tick) {
        window.session().seek(tick);
        settle();
    }
    /// All numbers are there, and drawn.
    void settlePlots() {
        settle();
        plots().settle();
        QApplication::processEvents();
    }
    const PlotCurve& curve(const QString& name, bool ghost = false) {
        for (const PlotCurve& curve : view().curves())
            if (curve.ghost == ghost && curve.name.startsWith(name)) return curve;
        ADD_FAILURE() << "no curve " << name.toStdString();
        static const PlotCurve none;
        return none;
    }
    void plot(const ValueKey& key) { ASSERT_TRUE(plots().add(key)); }
    QPoint onCanvas(std::int64_t tick) const {
        return {static_cast<int>(std::lround(window.plots().view().pixelOf(static_cast<double>(tick)))), 20};
    }
};

TEST_F(PlotTest, NumbersAreThoseOfStepAtEveryTick) {
    seek(600);
    plot({"speed", "red 2"});
    plot({"x", "ball"});
    plot({"command_w", "red 3"});
    plot({"active_w", "red 3"});
    plot({"distance", "red 2", "ball"});
    plot({"impulse", "blue 2"});
    plot({"predicted_x", "red 4"});
    plot({"seen_error", "red 3", "ball"});
    plot({"note", "red 1", "distance"});
    ASSERT_TRUE(plots().addExpression("robot['red 2'].v + #robot"));
    settlePlots();
    WorldState state = scenario().initialState();
    StepBuffers buffers;
    StepTrace trace;
    double noted = std::nan(""), off = std::nan("");
    bool inSight = false;
    Pose self;
    Point seen;
    const auto dead = scenario().scene().modelOf(2).deadTimes();
    int touches = 0, errors = 0;
    for (std::int64_t tick = 0; tick <= 600; ++tick) {
        const auto expect = [&](const char* name, double expected) {
            const double plotted = curve(name).at(tick);
            const bool same = std::isnan(expected) ? std::isnan(plotted)
                                                   : plotted == static_cast<double>(static_cast<float>(expected));
            errors += same ? 0 : 1;
            EXPECT_TRUE(same || errors > 10) << name << " at " << tick << ": " << plotted << ", not " << expected;
        };
        const RobotState& red2 = state.robots[1];
        const Pose& ball = state.objects[0].pose;
        expect("red 2  speed", std::hypot(red2.velocity_B.x, red2.velocity_B.y));
        expect("ball  x", ball.x);
        const CommandView commands = scenario().commandsOf(state, 2);
        const Nanoseconds now = scenario().scene().timeOf(tick);
        expect("red 3  command_w", commands.at(now).w);
        expect("red 3  active_w", commands.at(now - dead.w).w);
        expect("red 2  distance", std::hypot(red2.pose.x - ball.x, red2.pose.y - ball.y));
        double impulse = 0;
        for (const ContactReport& contact : trace.contacts)
            if (tick > 0 && (contact.bodyA == 5 || contact.bodyB == 5)) impulse += contact.impulse;
        touches += impulse > 0 ? 1 : 0;
        expect("blue 2  impulse", impulse);
        const MotionSegment& way = state.robots[3].segment;
        expect("red 4  predicted_x", (way.start * way.increment).x);
        expect("red 1  note distance", noted);
        off = std::nan("");
        if (inSight) {
            const double c = std::cos(self.heading), s = std::sin(self.heading);
            const double x = self.x + c * seen.x - s * seen.y;
            const double y = self.y + s * seen.x + c * seen.y;
            off = std::hypot(x - ball.x, y - ball.y);
        }
        const double plotted = curve("red 3  seen_error").at(tick);
        EXPECT_TRUE(std::isnan(off) ? std::isnan(plotted) : std::abs(plotted - off) < 1e-6) << tick;
        expect("robot['red 2'].v", red2.velocity_B.x + 8);
        step(scenario(), state, buffers, {}, &trace);
        if (trace.robots[0].decided) {
            noted = std::nan("");
            for (const Annotation& note : trace.robots[0].decision.annotations)
                if (note.label == "distance (m)") noted = note.value;
        }
        if (const StepTrace::Robot& told = trace.robots[2]; told.decided) {
            inSight = told.observation.localised() && !told.observation.objects().empty();
            self = told.observation.self();
            if (inSight) seen = told.observation.objects().front().position_B;
        }
    }
    EXPECT_EQ(errors, 0);
    EXPECT_GT(touches, 0);
}

/// In the unit that people are shown.
TEST_F(PlotTest, EveryValueOfTheCatalogueIsPlottedAsAConditionHasIt) {
    seek(333);
    const FieldFrame& frame = *window.shown()->frame;
    const Moment moment = frame.moment();
    std::size_t known = 0;
    for (const ValueKey& key : valuesAt(moment)) {
        const auto bound = boundValue(scenario(), key);
        ASSERT_TRUE(bound);
        const std::string path = pathOf(scenario(), *bound);
        if (std::holds_alternative<std::string>(bound->value(moment))) continue;
        const auto plotted = plottedValue(scenario(), key),
                   expression = plottedValue(scenario(), {"expression", "", path});
        ASSERT_TRUE(plotted && expression) << path;
        const double shown = plotted->read(moment), number = expression->read(moment);
        if (std::isnan(number)) {
            EXPECT_TRUE(std::isnan(shown)) << path;
            continue;
        }
        ++known;
        EXPECT_EQ(shown, plotted->angle ? wrapAngle(number) * 180 / std::numbers::pi : number) << path;
    }
    EXPECT_GT(known, 500u);
}

TEST_F(PlotTest, NewTicksArePlottedAsTheyCome) {
    plot({"x", "ball"});
    for (int i = 0; i < 40; ++i) {
        key(Qt::Key_Right);
        settlePlots();
        EXPECT_FLOAT_EQ(static_cast<float>(curve("ball  x").at(state().tick)),
                        static_cast<float>(state().objects[0].pose.x));
    }
    EXPECT_EQ(plots().series().behind(), 0);
}

TEST_F(PlotTest, PressAndDragAskForTheTickThere) {
    seek(500);
    plot({"speed", "red 2"});
    settlePlots();
    QTest::mouseClick(&canvas(), Qt::LeftButton, Qt::NoModifier, onCanvas(120));
    settle();
    EXPECT_EQ(window.shown()->tick(), view().tickAt(onCanvas(120).x()));
    EXPECT_NEAR(static_cast<double>(window.shown()->tick()), 120, 1);
    const auto send = [&](QEvent::Type type, std::int64_t tick) {
        const bool moves = type == QEvent::MouseMove;
        QMouseEvent event(type, onCanvas(tick), moves ? Qt::NoButton : Qt::LeftButton,
                          type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&canvas(), &event);
        settle();
    };
    send(QEvent::MouseButtonPress, 200);
    for (const std::int64_t tick : {210, 260, 340}) {
        send(QEvent::MouseMove, tick);
        EXPECT_NEAR(static_cast<double>(window.shown()->tick()), static_cast<double>(tick), 1);
    }
    send(QEvent::MouseButtonRelease, 340);
    send(QEvent::MouseMove, 400);
    EXPECT_NEAR(static_cast<double>(window.shown()->tick()), 340, 1) << "without a button nothing moves";
}

TEST_F(PlotTest, CursorStandsAtTheShownTickAndCurvesWhereTheirNumbersAre) {
    seek(400);
    plot({"x", "red 2"});
    plot({"heading", "blue 1"});
    settlePlots();
    const QColor accent = Theme::light().accent;
    for (const std::int64_t tick : {60, 250}) {
        seek(tick);
        settlePlots();
        const QImage image = canvas().grab().toImage();
        EXPECT_EQ(image.pixelColor(onCanvas(tick)).rgb(), accent.rgb());
        EXPECT_NE(image.pixelColor(onCanvas(tick) + QPoint(12, 0)).rgb(), accent.rgb());
    }
    const QImage image = canvas().grab().toImage();
    for (const char* name : {"red 2  x", "blue 1  heading"}) {
        const PlotCurve& drawn = curve(name);
        for (const std::int64_t tick : {100, 180, 330}) {
            const auto place = view().placeOf(drawn.id, static_cast<double>(tick), drawn.at(tick));
            ASSERT_TRUE(place);
            int nearest = 255 * 3;
            for (int dy = -1; dy <= 1; ++dy) {
                const QColor pixel = image.pixelColor(place->toPoint() + QPoint(0, dy));
                nearest = std::min(nearest, std::abs(pixel.red() - drawn.colour.red()) +
                                                std::abs(pixel.green() - drawn.colour.green()) +
                                                std::abs(pixel.blue() - drawn.colour.blue()));
            }
            EXPECT_LT(nearest, 120) << name << " at " << tick;
        }
    }
}

TEST_F(PlotTest, BranchAndWhatItDepartedFromAgreeBeforeAndDifferAfter) {
    seek(420);
    seek(300);
    plot({"x", "red 3"});
    drag(pixelOf(2), pixelOf(2) + QPointF(40, -30));
    seek(420);
    settlePlots();
    ASSERT_EQ(window.shown()->branch, 1u);
    const PlotCurve& now = curve("red 3  x");
    const PlotCurve& ghost = curve("red 3  x", true);
    WorldState expected = scenario().initialState();
    StepBuffers buffers;
    for (std::int64_t tick = 0; tick <= 420; ++tick) {
        EXPECT_EQ(ghost.at(tick), static_cast<double>(static_cast<float>(expected.robots[2].pose.x))) << tick;
        if (tick < 300)
            EXPECT_EQ(now.at(tick), ghost.at(tick)) << tick;
        else
            EXPECT_GT(std::abs(now.at(tick) - ghost.at(tick)), 1e-4) << tick;
        step(scenario(), expected, buffers);
    }
    EXPECT_EQ(now.at(420), static_cast<double>(static_cast<float>(state().robots[2].pose.x)));
    EXPECT_NE(view().textAt(350).indexOf("the run"), -1) << "the read-out has both";
}

TEST_F(PlotTest, LongPastComesInPartsWhileTheWindowLives) {
    constexpr std::int64_t length = 12'000;
    seek(length);
    plot({"speed", "red 2"});
    std::vector<std::int64_t> behind;
    int seen = 0;
    QObject::connect(&plots().computing(), &SeriesWorker::grown, &window, [&] {
        behind.push_back(plots().series().behind());
        seen += std::isfinite(curve("red 2  speed").at(100)) ? 1 : 0;
        // The session answers meanwhile.
        if (behind.size() == 2) window.session().seek(50);
    });
    while (plots().series().behind() > 0) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    settle();
    EXPECT_GT(behind.size(), 3u);
    EXPECT_GT(behind.front(), 0);
    EXPECT_TRUE(std::is_sorted(behind.rbegin(), behind.rend()));
    EXPECT_GT(seen, 2);
    EXPECT_EQ(window.shown()->tick(), 50);
    for (std::int64_t tick = 0; tick <= length; ++tick) ASSERT_TRUE(std::isfinite(curve("red 2  speed").at(tick)));
}

TEST_F(PlotTest, CancelKeepsWhatIsThereAndWhatComes) {
    constexpr std::int64_t length = 12'000;
    seek(length);
    plot({"x", "ball"});
    bool parts = false;
    QObject::connect(&plots().computing(), &SeriesWorker::grown, &window, [&] {
        if (parts) return;
        parts = true;
        window.actions()["stop_plots"].trigger();
    });
    while (!parts) QApplication::processEvents(QEventLoop::WaitForMoreEvents);
    EXPECT_EQ(plots().series().behind(), 0);
    EXPECT_TRUE(std::isfinite(curve("ball  x").at(0)));
    EXPECT_TRUE(std::isnan(curve("ball  x").at(length)));
    seek(length + 5);
    settlePlots();
    EXPECT_TRUE(std::isnan(curve("ball  x").at(length)));
    for (std::int64_t tick = length + 1; tick <= length + 5; ++tick)
        EXPECT_TRUE(std::isfinite(curve("ball  x").at(tick)));
    EXPECT_EQ(curve("ball  x").at(length + 5), static_cast<double>(static_cast<float>(state().objects[0].pose.x)));
}

TEST_F(PlotTest, WheelZoomsTheTimeAtTheMouseAndADoubleClickShowsAll) {
    seek(800);
    plot({"speed", "red 2"});
    settlePlots();
    const QPoint at = onCanvas(200);
    const std::int64_t under = view().tickAt(at.x());
    const double before = view().axis().to() - view().axis().from();
    QWheelEvent wheel(at, canvas().mapToGlobal(at), {}, {0, 240}, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase,
                      false);
    QApplication::sendEvent(&canvas(), &wheel);
    EXPECT_NEAR((view().axis().to() - view().axis().from()) * 1.44, before, 1e-6);
    EXPECT_EQ(view().tickAt(at.x()), under);
    seek(0);
    EXPECT_LE(view().axis().from(), 0) << "the view goes along with now";
    QTest::mouseDClick(&canvas(), Qt::LeftButton, Qt::NoModifier, onCanvas(100));
    EXPECT_TRUE(view().axis().showsAll());
    EXPECT_LE(view().axis().from(), 0);
    EXPECT_GE(view().axis().to(), 800);
}

TEST_F(PlotTest, ReadOutSaysNumbersWithUnits) {
    seek(300);
    plot({"x", "ball"});
    plot({"heading", "red 1"});
    settlePlots();
    const QString text = view().textAt(150);
    EXPECT_TRUE(text.contains("3.00 s")) << text.toStdString();
    EXPECT_TRUE(text.contains(fixedText(curve("ball  x").at(150), 3) + "</td><td>&nbsp;m<"));
    EXPECT_TRUE(
        text.contains(fixedText(curve("red 1  heading").at(150), 1) + QString::fromUtf8("</td><td>&nbsp;\u00b0")));
    QTest::mouseMove(window.windowHandle(), canvas().mapTo(&window, onCanvas(150)));
    QMouseEvent move(QEvent::MouseMove, onCanvas(150), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
    QApplication::sendEvent(&canvas(), &move);
    EXPECT_TRUE(view().findChild<QLabel*>()->isVisible());
    EXPECT_EQ(window.shown()->tick(), 300) << "to look is not to go";
}

TEST_F(PlotTest, ExpressionsThatAreWrongSaySoInALine) {
    auto* line = plots().findChild<QLineEdit*>();
    window.actions()["plot_expression"].trigger();
    EXPECT_TRUE(plots().isVisible());
    QTest::keyClicks(line, "robot[99].x");
    QTest::keyClick(line, Qt::Key_Return);
    EXPECT_TRUE(plots().keys().empty());
    const auto said = [&] {
        for (const QLabel* label : plots().findChildren<QLabel*>())
            if (label->isVisible() && label->text().contains("robot 99")) return true;
        return false;
    };
    EXPECT_TRUE(said());
    line->clear();
    QTest::keyClicks(line, "robot[2].x * 100");
    EXPECT_FALSE(said()) << "gone when one writes";
    QTest::keyClick(line, Qt::Key_Return);
    settlePlots();
    ASSERT_EQ(plots().keys().size(), 1u);
    EXPECT_EQ(curve("robot[2].x * 100").at(0), static_cast<double>(static_cast<float>(state().robots[1].pose.x * 100)));
    EXPECT_FALSE(window.actions().perform("plot_expression", QString("nothing[")));
    EXPECT_TRUE(window.actions().perform("plot_expression", QString("time")));
}

TEST_F(PlotTest, CurvesHaveTheirRobotsColoursAndAnAxisForEachUnit) {
    for (const char* robot : {"red 1", "red 2", "blue 4"}) plot({"speed", robot});
    plot({"heading", "red 1"});
    settlePlots();
    EXPECT_EQ(canvas().axisRectCount(), 2);
    EXPECT_EQ(view().titles(), (QStringList{"speed (m/s)", QString::fromUtf8("heading (\u00b0)")}));
    for (const auto& [key, colour] : plots().plotted()) {
        const QColor robot = robotColour(bodyNamed(scenario().scene(), key.body));
        if (robot.saturation() > 60) {
            EXPECT_NEAR(colour.hue(), robot.hue(), 3) << key.body;
        }
    }
    plots().remove({"heading", "red 1"});
    settlePlots();
    EXPECT_EQ(canvas().axisRectCount(), 1);
}

/// In both themes: by their lines, and by how light they are, also to who sees no hues; and from the ground.
TEST_F(PlotTest, CurvesOfOneRobotAreToldApart) {
    for (const bool dark : {false, true}) {
        if (dark) window.actions()["dark"].trigger();
        const QColor ground = dark ? Theme::darkOne().surround : QColor(Qt::white);
        for (std::size_t robot = 0; robot < scenario().scene().robots.size(); ++robot) {
            const std::string& name = scenario().scene().robots[robot].name;
            plots().clear();
            for (const char* quantity : {"speed", "command_v", "active_v"}) plot({quantity, name});
            const std::vector<PlotCurve>& curves = view().curves();
            ASSERT_EQ(curves.size(), 3u);
            std::set<Qt::PenStyle> styles;
            for (const PlotCurve& one : curves) {
                styles.insert(one.style);
                EXPECT_GT(contrast(one.colour, ground), 1.8) << name << ' ' << dark;
            }
            EXPECT_EQ(styles.size(), 3u);
            EXPECT_GT(contrast(curves[0].colour, curves[1].colour), 1.5) << name << ' ' << dark;
        }
    }
}

TEST_F(PlotTest, GhostsAreThinnerAndPalerThanWhatTheyAreGhostsOf) {
    PlotCurve curve;
    curve.style = Qt::DashLine;
    PlotCurve ghost = curve;
    ghost.ghost = true;
    EXPECT_LT(curvePen(ghost).widthF(), curvePen(curve).widthF());
    EXPECT_LT(curvePen(ghost).color().alpha(), curvePen(curve).color().alpha());
    EXPECT_EQ(curvePen(ghost).dashPattern(), curvePen(curve).dashPattern());
}

TEST_F(PlotTest, AnotherRunKeepsOnlyWhatItHas) {
    plot({"x", "ball"});
    plot({"x", "red 1"});
    ASSERT_TRUE(window.open("soccer.toml"));
    settlePlots();
    EXPECT_EQ(plots().keys().size(), 2u);
    EXPECT_TRUE(std::isfinite(curve("ball  x").at(0)));
    ASSERT_TRUE(window.open("b21_corridor.toml"));
    settlePlots();
    for (const ValueKey& key : plots().keys()) EXPECT_NE(bodyNamed(scenario().scene(), key.body), noBody);
    EXPECT_LT(plots().keys().size(), 2u);
}

TEST(CurveSampling, KeepsTheLeastAndGreatestOfEachStep) {
    TickNumbers numbers{100, {}};
    for (int i = 0; i < 1000; ++i) numbers.values.push_back(static_cast<float>(std::sin(i * 0.7) + (i == 437 ? 9 : 0)));
    QVector<QPointF> all, few;
    sampleCurve(numbers, 0, 2000, 1, false, all);
    sampleCurve(numbers, 0, 2000, 50, false, few);
    ASSERT_EQ(all.size(), 1000);
    EXPECT_EQ(all.front(), QPointF(100, static_cast<double>(numbers.values[0])));
    EXPECT_LE(few.size(), 4 * 20 + 4);
    for (int begin = 100; begin < 1100; begin += 50) {
        double least = 10, most = -10, drawnLeast = 10, drawnMost = -10;
        for (const QPointF& point : all)
            if (point.x() >= begin && point.x() < begin + 50)
                least = std::min(least, point.y()), most = std::max(most, point.y());
        for (const QPointF& point : few)
            if (point.x() >= begin && point.x() < begin + 50)
                drawnLeast = std::min(drawnLeast, point.y()), drawnMost = std::max(drawnMost, point.y());
        EXPECT_EQ(least, drawnLeast);
        EXPECT_EQ(most, drawnMost);
    }
    for (int i = 1; i < few.size(); ++i) EXPECT_LT(few[i - 1].x(), few[i].x());
}

TEST(CurveSampling, LeavesGapsAndDoesNotJoinAcrossAHalfTurn) {
    const float gap = std::numeric_limits<float>::quiet_NaN();
    QVector<QPointF> points;
    sampleCurve({0, {1, gap, gap, 2}}, 0, 10, 1, false, points);
    ASSERT_EQ(points.size(), 3);
    EXPECT_TRUE(std::isnan(points[1].y()));
    points.clear();
    sampleCurve({0, {179, -179, -178}}, 0, 10, 1, true, points);
    ASSERT_EQ(points.size(), 4);
    EXPECT_TRUE(std::isnan(points[1].y()));
}

}  // namespace
}  // namespace mrose::gui
