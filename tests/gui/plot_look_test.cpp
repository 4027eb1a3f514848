// Whether plots can be read: what is pale, where titles stand, how low an axis gets, what the legend says.
#include <QLineEdit>
#include <QScrollArea>
#include <QScrollBar>

#include <gmock/gmock.h>
#include <qcustomplot.h>

#include "gui/overlay_fixture.h"
#include "panels/curve_list.h"
#include "panels/plot_panel.h"
#include "reality/error_plot.h"
#include "widgets/field_view.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

using testing::ElementsAre;

TEST(AheadPen, IsSeenOnEveryGroundAndThinnerThanWhatIsSimulated) {
    for (const Theme& theme : {Theme::light(), Theme::darkOne()})
        for (const QColor& ground : {theme.dark ? theme.surround : QColor(Qt::white), theme.surround,
                                     theme.dark ? theme.panel.lighter(115) : theme.panel})
            for (std::size_t i = 0; i < 16; ++i) {
                PlotCurve curve;
                curve.colour = i < 8 ? robotColour(i) : modelColour(i - 8);
                curve.ahead = {{0, 0}, {1, 1}};
                const QPen pen = aheadPen(curve, ground);
                EXPECT_GE(contrast(pen.color(), ground), 2) << i << ' ' << ground.name().toStdString();
                EXPECT_LE(pen.widthF(), 0.7 * curvePen(curve).widthF());
                if (contrast(curve.colour, ground) > 3) {
                    EXPECT_LT(contrast(pen.color(), ground), contrast(curve.colour, ground));
                }
            }
}

class PlotLookTest : public OverlayTest {
protected:
    PlotPanel& plots() { return window.plots(); }
    QCustomPlot& canvas() { return *plots().view().findChild<QCustomPlot*>(); }
    CurveList& legend() { return *plots().findChild<CurveList*>(); }
    std::vector<std::string> legendLines() {
        std::vector<std::string> lines;
        for (int i = 0; i < legend().topLevelItemCount(); ++i)
            lines.push_back(legend().topLevelItem(i)->text(0).toStdString());
        return lines;
    }
    void plot(const std::vector<const char*>& quantities, std::size_t body) {
        window.errorPlot().settle();
        for (const char* quantity : quantities)
            ASSERT_TRUE(plots().add({quantity, window.shown()->frame->nameOf(body)})) << quantity;
        settleAll();
        plots().settle();
        QApplication::processEvents();
    }
    /// A second robot that drives as the first one does.
    void openTwo() {
        const std::string file = makeLog([](Log& log) {
            log.robots[0].robot = "a";
            log.robots.push_back(log.robots[0]);
            log.robots[1].robot = "b";
            for (Trajectory& trajectory : log.robots[1].trajectories)
                for (StampedPose& stamped : trajectory.poses) stamped.pose.y += 5;
        });
        ASSERT_NO_FATAL_FAILURE(openLog(file));
        window.errorPlot().settle();
        plots().clear();
    }
};

TEST_F(PlotLookTest, TitlesStandBesideTheCurvesRoom) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    plot({"speed", "x"}, 0);
    int titles = 0;
    for (int i = 0; i < canvas().itemCount(); ++i) {
        auto* title = qobject_cast<QCPItemText*>(canvas().item(i));
        if (title == nullptr) continue;
        ++titles;
        const QRectF box(title->topLeft->pixelPosition(), title->bottomRight->pixelPosition());
        EXPECT_TRUE(QRectF(canvas().rect()).contains(box)) << title->text().toStdString();
        for (int axes = 0; axes < canvas().axisRectCount(); ++axes)
            EXPECT_FALSE(box.intersects(canvas().axisRect(axes)->rect())) << title->text().toStdString() << ' ' << axes;
    }
    EXPECT_EQ(titles, 4);
}

/// Wherever the mouse is: within the plot, beside it, and off the curves where there is room.
TEST_F(PlotLookTest, ReadOutStaysWithinThePlotBesideTheMouse) {
    ASSERT_NO_FATAL_FAILURE(openTwo());
    plot({"command_v", "v", "real_v"}, 0);
    auto* readOut = plots().view().findChild<QLabel*>();
    for (const int width : {1280, 900}) {
        window.resize(width, 800);
        settleAll();
        const QCPAxisRect& axes = *canvas().axisRect(0);
        for (double share = 0.02; share < 1; share += 0.07) {
            const QPoint mouse(axes.left() + static_cast<int>(share * axes.width()), axes.center().y());
            QMouseEvent move(QEvent::MouseMove, mouse, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
            QApplication::sendEvent(&canvas(), &move);
            const QRect box = readOut->geometry(), area = plots().view().rect();
            EXPECT_TRUE(area.contains(box)) << share << " of " << width;
            // Where it stands over the mouse there is no room at either side.
            const bool over = box.left() <= mouse.x() && box.right() >= mouse.x();
            EXPECT_TRUE(!over || std::max(mouse.x(), area.right() - mouse.x()) <= box.width() + 14)
                << share << " of " << width;
        }
    }
}

/// One that is high at the left and low at the right.
TEST_F(PlotLookTest, ReadOutStandsWhereNoCurveIs) {
    PlotView view;
    PlotCurve curve;
    curve.id = curve.name = "falls";
    curve.at = [](std::int64_t tick) { return tick < 500 ? 1.0 : 0.0; };
    curve.sample = [](std::int64_t from, std::int64_t to, std::int64_t, QVector<QPointF>& points) {
        for (std::int64_t tick = from; tick <= to; ++tick) points.append({double(tick), tick < 500 ? 1.0 : 0.0});
    };
    view.resize(900, 300);
    view.show();
    view.setCurves({curve});
    view.setTime({0, 1000, 0});
    view.showRange(0, 1000);
    view.draw();
    auto* plot = view.findChild<QCustomPlot*>();
    auto* readOut = view.findChild<QLabel*>();
    for (const double tick : {100.0, 850.0}) {
        const QPointF on = *view.placeOf("falls", tick, curve.at(std::int64_t(tick)));
        QMouseEvent move(QEvent::MouseMove, on, Qt::NoButton, Qt::NoButton, Qt::NoModifier);
        QApplication::sendEvent(plot, &move);
        ASSERT_TRUE(readOut->isVisible());
        const QRect box = readOut->geometry();
        for (int x = box.left(); x <= box.right(); ++x) {
            const std::int64_t at = view.tickAt(x);
            if (std::abs(at - 500) < 3) continue;
            const QPointF point = *view.placeOf("falls", double(at), curve.at(at));
            EXPECT_FALSE(box.contains(point.toPoint())) << tick << ' ' << at;
        }
    }
}

TEST_F(PlotLookTest, ManyAxesAreScrolledAndNotSqueezed) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    auto* area = plots().findChild<QScrollArea*>();
    const int before = plots().height();
    EXPECT_FALSE(area->verticalScrollBar()->isVisible());
    plot({"speed", "w", "x"}, 0);
    ASSERT_EQ(canvas().axisRectCount(), 5);
    for (int i = 0; i < 5; ++i) EXPECT_GE(canvas().axisRect(i)->height(), 40) << i;
    EXPECT_TRUE(area->verticalScrollBar()->isVisible());
    EXPECT_EQ(plots().height(), before);
    plots().clear();
    plot({"speed"}, 0);
    EXPECT_FALSE(area->verticalScrollBar()->isVisible());
}

TEST_F(PlotLookTest, CurvesUnderTheNameOfTheirRobotAreCalledByTheirQuantity) {
    ASSERT_NO_FATAL_FAILURE(openTwo());
    const std::string first = window.shown()->frame->nameOf(0);
    plot({"speed", "command_v", "x"}, 0);
    EXPECT_THAT(legendLines(), ElementsAre(first, "speed", "command_v", "x"));
}

TEST_F(PlotLookTest, SpeedsAreCalledByWhatDiffers) {
    ASSERT_NO_FATAL_FAILURE(openTwo());
    const std::string first = window.shown()->frame->nameOf(0), second = window.shown()->frame->nameOf(1);
    plot({"command_v", "v", "real_v", "command_w", "w", "real_w"}, 0);
    EXPECT_THAT(legendLines(), ElementsAre("v (m/s)", "command", "simulated", "logged", "w (rad/s)", "command",
                                           "simulated", "logged"));
    const QString name = qtText(first);
    EXPECT_EQ(plots().view().titles(), (QStringList{name + ": v (m/s)", name + ": w (rad/s)"}));
    const QFontMetrics metrics(legend().font());
    for (int i = 0; i < legend().topLevelItemCount(); ++i)
        EXPECT_LT(metrics.horizontalAdvance(legend().topLevelItem(i)->text(0)) + legend().iconSize().width(),
                  legend().columnWidth(0));
    plot({"command_v", "real_v"}, 1);
    EXPECT_THAT(legendLines(), ElementsAre(first, "command", "simulated", "logged", "command", "simulated", "logged",
                                           second, "command", "logged"));
    EXPECT_EQ(plots().view().titles().front(), "v (m/s)");
    // Each line has its own number, and is removed alone.
    EXPECT_EQ(legend().topLevelItem(0)->text(1), "");
    legend().setFocus();
    legend().setCurrentItem(legend().topLevelItem(8));
    QTest::keyClick(&legend(), Qt::Key_Delete);
    EXPECT_EQ(plots().plotted().count({"command_v", second}), 0u);
    EXPECT_EQ(plots().keys().size(), 7u);
    legend().setCurrentItem(legend().topLevelItem(0));
    QTest::keyClick(&legend(), Qt::Key_Delete);
    EXPECT_EQ(plots().keys().size(), 7u) << "a name is no curve";
    plots().clear();
    plot({"speed", "command_v", "active_v"}, 0);
    EXPECT_THAT(legendLines(), ElementsAre(first, "speed", "command_v", "active_v"))
        << "their axis is called by none of them";
}

TEST_F(PlotLookTest, LegendTellsTheCurvesAndBoundsOfTwoAxesApart) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    window.errorPlot().settle();
    settleAll();
    const std::string own = overlay.models().all().front().name;
    EXPECT_THAT(legendLines(), ElementsAre("error (cm)", own, "bound", "heading_error (\u00b0)", own, "bound"));
    // A line is removed, whichever place it has.
    legend().setFocus();
    legend().setCurrentItem(legend().topLevelItem(4));
    QTest::keyClick(&legend(), Qt::Key_Delete);
    ASSERT_EQ(plots().keys().size(), 1u);
    EXPECT_EQ(plots().keys()[0].quantity, positionErrorQuantity);
    // Of one axis each has its unit; the bound is known from the beginning on.
    EXPECT_THAT(legendLines(), ElementsAre(own, "bound"));
    ASSERT_EQ(window.shown()->tick(), 0);
    EXPECT_EQ(legend().topLevelItem(1)->text(1),
              fixedText(100 * overlay.rollouts().shownRow()->bound.at(0).position, 1));
    EXPECT_EQ(legend().topLevelItem(1)->text(2), "cm");
}

/// In both themes, for robots of any colour.
TEST(CurveLooks, RealSimulatedAndCommandAreToldApartAndSeen) {
    for (const Theme& theme : {Theme::light(), Theme::darkOne()})
        for (std::uint32_t robot = 0; robot < 8; ++robot) {
            std::vector<ValueKey> keys;
            std::vector<PlottedValue> values;
            for (const char* const quantity : {"v", "command_v", "real_v"}) {
                keys.push_back({quantity, "one"});
                values.push_back({quantity, "m/s", 3, false, robot, {}});
            }
            const std::vector<CurveLook> looks = looksOf(keys, values, nullptr, theme);
            const QColor ground = theme.dark ? theme.surround : QColor(Qt::white);
            for (const CurveLook& look : looks)
                EXPECT_GE(contrast(look.colour, ground), theme.dark ? 4.5 : 3) << robot << ' ' << theme.dark;
            EXPECT_NE(looks[0].colour, looks[2].colour);
            EXPECT_EQ(looks[2].colour, theme.text) << "the real one's";
            EXPECT_NE(looks[0].style, looks[1].style);
            EXPECT_GE(contrast(looks[0].colour, looks[1].colour), 1.4) << robot << ' ' << theme.dark;
            // Of two robots their colours say which is which.
            keys.push_back({"real_v", "other"});
            values.push_back({"real_v", "m/s", 3, false, (robot + 1) % 8, {}});
            EXPECT_NE(looksOf(keys, values, nullptr, theme)[2].colour, looksOf(keys, values, nullptr, theme)[3].colour);
        }
}

TEST_F(PlotLookTest, ClosedLogLeavesNoRealCurves) {
    ASSERT_NO_FATAL_FAILURE(openTwo());
    plot({"v", "real_v", "error_ahead"}, 0);
    ASSERT_EQ(plots().keys().size(), 3u);
    window.actions()["close_log"].trigger();
    settleAll();
    ASSERT_EQ(plots().keys().size(), 1u);
    EXPECT_EQ(plots().keys()[0].quantity, "v");
    EXPECT_EQ(legendLines().size(), 1u);
}

/// As on a screen of 1024 x 620.
TEST_F(PlotLookTest, NothingIsCutOffInANarrowPanel) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    plot({"v", "real_v"}, 0);
    for (const int width : {304, 420}) {
        plots().setParent(nullptr);
        plots().resize(width, 210);
        plots().show();
        settleAll();
        const QRect all = plots().rect();
        for (const QWidget* part : {static_cast<QWidget*>(&legend()), static_cast<QWidget*>(&plots().view()),
                                    static_cast<QWidget*>(plots().findChild<QLineEdit*>())})
            EXPECT_TRUE(all.contains(QRect(part->mapTo(&plots(), QPoint(0, 0)), QSize(part->width(), 1))))
                << part->metaObject()->className() << ' ' << width;
        const auto* box = plots().findChild<QLineEdit*>();
        EXPECT_LT(box->fontMetrics().horizontalAdvance(box->placeholderText()) + 8, box->width());
        for (int i = 0; i < canvas().itemCount(); ++i)
            if (auto* title = qobject_cast<QCPItemText*>(canvas().item(i))) {
                EXPECT_LE(title->bottomRight->pixelPosition().x(), canvas().width()) << title->text().toStdString();
                EXPECT_TRUE(title->text().endsWith(')')) << title->text().toStdString();
            }
        EXPECT_LE(legend().viewport()->width(), legend().width());
        EXPECT_GE(legend().columnWidth(0), 60);
    }
}

TEST_F(PlotLookTest, SpeedsFollowTheRobotUntilOneIsRemoved) {
    ASSERT_NO_FATAL_FAILURE(openTwo());
    const std::string first = window.shown()->frame->nameOf(0), second = window.shown()->frame->nameOf(1);
    const auto bodies = [&] {
        std::map<std::string, int> count;
        for (const ValueKey& key : plots().keys()) ++count[key.body];
        return count;
    };
    const auto press = [&] {
        QTest::keyClick(&window, Qt::Key_V, Qt::ShiftModifier);
        settleAll();
    };
    const auto select = [&](std::size_t body) {
        window.field().setSelected(body);
        settleAll();
    };
    using Count = std::map<std::string, int>;
    select(0);
    plot({"x"}, 0);
    press();
    EXPECT_EQ(bodies(), (Count{{first, 7}}));
    select(1);
    EXPECT_EQ(bodies(), (Count{{first, 1}, {second, 6}}));
    EXPECT_EQ(plots().keys().front().quantity, "x") << "they stand where they stood";
    ASSERT_TRUE(overlay.shown().show(0, 0));
    settleAll();
    EXPECT_EQ(window.field().selected(), 0u);
    EXPECT_EQ(bodies(), (Count{{first, 7}}));
    press();
    EXPECT_EQ(bodies(), (Count{{first, 1}}));
    press();
    plots().remove({"w", first});
    select(1);
    EXPECT_EQ(bodies(), (Count{{first, 6}})) << "what was chosen by hand stays";
}

class ResizeCount final : public QObject {
public:
    int count = 0;
    bool eventFilter(QObject*, QEvent* event) override {
        count += event->type() == QEvent::Resize ? 1 : 0;
        return false;
    }
};

/// With and without a divergence and its cause.
TEST_F(PlotLookTest, ListOfRolloutsKeepsItsHeightFromRolloutToRollout) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    overlay.setBound({{0.02, 0.2}, false});
    settleAll();
    std::size_t first = 0;
    const int whole = panel.list().height();
    while (!overlay.rollouts().shownRow()->divergence) {
        EXPECT_EQ(panel.list().height(), whole) << "nothing has left yet: the list has the room";
        ASSERT_TRUE(overlay.shown().show(++first));
        settleAll();
    }
    ASSERT_GT(first, 0u);
    const int height = panel.list().height();
    EXPECT_LT(height, whole);
    int with = 0, without = 0;
    ResizeCount resizes;
    panel.list().installEventFilter(&resizes);
    for (std::size_t i = 1; i <= overlay.rollouts().requests().size(); ++i) {
        const std::size_t rollout = i % overlay.rollouts().requests().size();
        ASSERT_TRUE(overlay.shown().show(rollout));
        settleAll();
        ASSERT_NE(overlay.rollouts().shownRow(), nullptr);
        ++(overlay.rollouts().shownRow()->divergence ? with : without);
        EXPECT_EQ(panel.list().height(), height) << rollout;
        const QRect line = panel.list().visualRect(panel.list().currentIndex());
        EXPECT_TRUE(panel.list().viewport()->rect().contains({1, line.top(), 1, line.height()})) << rollout;
    }
    EXPECT_EQ(resizes.count, 0) << "not even for an instant";
    EXPECT_GT(with, 0);
    EXPECT_GT(without, 0);
}

}  // namespace
}  // namespace mrose::gui
