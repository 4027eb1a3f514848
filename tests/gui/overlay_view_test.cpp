// How an overlay is looked at: its list, and the field about the rollout that is picked.
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QTreeWidget>
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "gui/overlay_fixture.h"
#include "panels/breakpoint_panel.h"
#include "panels/plot_panel.h"
#include "scripting/window_script.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

class OverlayViewTest : public OverlayTest {
protected:
    QTreeView& list() { return panel.list(); }
    FieldView& field() { return window.field(); }
    /// Of both robots in the shown rollout.
    Area driven() {
        const Comparison alone = comparedAlone(overlay);
        Area area{{1, 1}, {-1, -1}};
        for (const ComparedRollout& rollout : alone.rollouts) {
            if (rollout.request != overlay.rollouts().shown()) continue;
            for (const Pose& pose : rollout.simulated) area.include(Point{pose.x, pose.y});
            for (const Pose& pose : rollout.real.truth)
                if (std::isfinite(pose.x)) area.include(Point{pose.x, pose.y});
        }
        return area;
    }
    /// All of the rollout is in the view, and fills it.
    void expectNear() {
        const Area area = driven(), seen = field().transform().shown();
        EXPECT_LT(seen.least.x, area.least.x);
        EXPECT_LT(seen.least.y, area.least.y);
        EXPECT_GT(seen.most.x, area.most.x);
        EXPECT_GT(seen.most.y, area.most.y);
        const double reach = window.shown()->frame->scene().shapeOf(0).reach;
        const auto wanted = [&](double size) { return std::max(1.2, 1.25 * (size + 2 * reach)); };
        // One of the two decides, beside margins and rulers.
        const double across = (seen.most.x - seen.least.x) / wanted(area.most.x - area.least.x);
        const double up = (seen.most.y - seen.least.y) / wanted(area.most.y - area.least.y);
        EXPECT_LT(std::min(across, up), 1.4);
    }
};

TEST_F(OverlayViewTest, PickedRolloutIsSeenFromNearUntilTheUserLooksElsewhere) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    EXPECT_FALSE(field().viewport().showsPart()) << "a log that is opened is seen whole";
    clickLine(0);
    ASSERT_TRUE(field().viewport().showsPart());
    expectNear();
    window.resize(1000, 700);
    settleAll();
    expectNear();
    ASSERT_TRUE(overlay.shown().showNext(overlay.rollouts().shown() == 0u ? 1 : -1));
    settleAll();
    EXPECT_TRUE(field().viewport().showsPart()) << "the next rollout as the one before";
    expectNear();
    field().viewport().zoom(0.5);
    EXPECT_FALSE(field().viewport().showsPart());
    const Area chosen = field().transform().shown();
    ASSERT_TRUE(overlay.shown().showNext(1));
    settleAll();
    EXPECT_EQ(field().transform().shown().least, chosen.least) << "what the user looks at stays";
    EXPECT_EQ(field().transform().shown().most, chosen.most);
    clickLine(1);
    EXPECT_TRUE(field().viewport().showsPart());
    window.actions()["fit"].trigger();
    EXPECT_FALSE(field().viewport().showsPart());
}

TEST_F(OverlayViewTest, ScaleAndTheFollowedRobotGoAlongFromRolloutToRollout) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    window.actions()["follow"].trigger();
    clickLine(0);
    window.session().seek(10);
    settleAll();
    const double near = field().transform().scale();
    ASSERT_GT(near, 1.5 * field().viewport().fittedScale(field().size()));
    const int by = *overlay.rollouts().shown() + 1 < overlay.rollouts().requests().size() ? 1 : -1;
    ASSERT_TRUE(overlay.shown().showNext(by));
    settleAll();
    EXPECT_EQ(field().transform().scale(), near);
    ASSERT_EQ(field().selected(), 0u);
    const Pose& robot = window.shown()->frame->poseOf(0);
    const Point middle = field().transform().shown().middle();
    EXPECT_NEAR(middle.x, robot.x, 1e-9);
    EXPECT_NEAR(middle.y, robot.y, 1e-9);
    window.actions()["follow"].trigger();
    window.actions()["fit"].trigger();
    ASSERT_TRUE(overlay.shown().showNext(-by));
    settleAll();
    EXPECT_TRUE(field().viewport().showsAll()) << "all of the place stays all of it";
}

TEST_F(OverlayViewTest, RolloutAsideOfWhatTheUserLooksAtIsSeenFromNear) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    field().viewport().zoom(3);
    field().viewport().pan({1e6, 0});
    ASSERT_TRUE(overlay.shown().showNext(1));
    settleAll();
    expectNear();
}

TEST_F(OverlayViewTest, KeysWalkThroughTheListAndOpenItsRollouts) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    clickLine(0);
    QTest::keyClick(&list(), Qt::Key_Down);
    QTest::keyClick(&list(), Qt::Key_Down);
    settleAll();
    EXPECT_EQ(list().currentIndex().row(), 2);
    EXPECT_EQ(overlay.rollouts().shown(), panel.rollouts()->row(2).rollout);
    expectNear();
}

/// Two robots: the first drives as simulated, the other one slides away.
class TwoRobotsTest : public OverlayViewTest {
protected:
    void SetUp() override {
        OverlayViewTest::SetUp();
        const std::string file = makeLog([](Log& log) {
            log.robots[0].robot = "a";
            log.robots.push_back(log.robots[0]);
            log.robots[1].robot = "b";
            for (Trajectory& trajectory : log.robots[1].trajectories) {
                const Nanoseconds begin = trajectory.poses.front().time;
                for (StampedPose& stamped : trajectory.poses) {
                    stamped.pose.x += 0.4 * toSeconds(stamped.time - begin);
                    stamped.pose.y += 5;
                }
            }
        });
        ASSERT_NO_FATAL_FAILURE(openLog(file));
        overlay.setBound({{0.3, 3}, false});
        settleAll();
        ASSERT_EQ(overlay.rollouts().world().robots().size(), 2u);
        ASSERT_FALSE(overlay.rollouts().rowOf(0, 0)->divergence);
        ASSERT_TRUE(overlay.rollouts().rowOf(0, 1)->divergence);
        leaves = window.shown()->frame->scene().ticksOf(overlay.rollouts().rowOf(0, 1)->divergence->time);
        window.field().setSelected(0);
        settleAll();
        ASSERT_EQ(overlay.rollouts().robot(), 0u);
    }
    std::int64_t leaves = 0;
};

TEST_F(TwoRobotsTest, KeyGoesToTheOneThatLeavesWhereTheSelectedOneStays) {
    QTest::keyClick(&window, Qt::Key_D);
    settleAll();
    EXPECT_EQ(window.shown()->tick(), leaves);
    EXPECT_EQ(overlay.rollouts().robot(), 1u);
    EXPECT_EQ(window.field().selected(), 1u);
}

/// A click beside all bodies takes the selection away, and nothing else.
TEST_F(TwoRobotsTest, ClickOnTheFloorLeavesTheRolloutThatIsAskedAbout) {
    ASSERT_GT(overlay.rollouts().rowOf(0, 1)->position, overlay.rollouts().rowOf(0, 0)->position)
        << "of the two the other one is the worse";
    const auto titles = window.plots().view().titles();
    const int line = list().currentIndex().row();
    const std::string says = panel.causes().text().toStdString();
    const Area floor = field().transform().shown();
    QTest::mouseClick(&field(), Qt::LeftButton, {},
                      field().transform().toPixels(floor.least + Point{0.2, 0.2}).toPoint());
    settleAll();
    EXPECT_FALSE(field().selected());
    EXPECT_EQ(overlay.rollouts().robot(), 0u);
    EXPECT_EQ(list().currentIndex().row(), line);
    EXPECT_EQ(panel.causes().text().toStdString(), says);
    EXPECT_EQ(window.plots().view().titles(), titles);
}

TEST_F(TwoRobotsTest, KeySelectsTheOneThatLeavesAndShowsItFromNear) {
    field().setSelected({});
    settleAll();
    ASSERT_TRUE(field().viewport().showsAll());
    const double whole = field().transform().scale();
    QTest::keyClick(&window, Qt::Key_D);
    settleAll();
    EXPECT_EQ(field().selected(), 1u);
    EXPECT_TRUE(field().viewport().showsPart());
    EXPECT_GT(field().transform().scale(), whole);
    field().viewport().zoom(0.5);
    const double chosen = field().transform().scale();
    QTest::keyClick(&window, Qt::Key_D);
    settleAll();
    EXPECT_EQ(field().transform().scale(), chosen) << "who has looked elsewhere stays there";
    // But not where it is out of sight, however one gets there.
    const auto seen = [&] {
        const QPointF pixel = field().transform().toPixels(position(state().robots[1].pose));
        return QRectF(field().rect()).contains(pixel);
    };
    const auto lookAside = [&] {
        seek(0);
        field().viewport().pan({4.0 * field().width(), 0});
        ASSERT_FALSE(seen());
    };
    ASSERT_NO_FATAL_FAILURE(lookAside());
    QTest::keyClick(&window, Qt::Key_D);
    settleAll();
    EXPECT_TRUE(seen());
    ASSERT_NO_FATAL_FAILURE(lookAside());
    Breakpoint onDivergence;
    onDivergence.text = "divergence";
    window.session().setBreakpoints({onDivergence});
    QTest::keyClick(&window, Qt::Key_F6);
    settleAll();
    EXPECT_EQ(window.shown()->tick(), leaves);
    EXPECT_TRUE(seen());
}

/// Of the second robot the ground truth is missing between 2 and 4 s.
class AbsentRobotTest : public OverlayViewTest {
protected:
    void SetUp() override {
        OverlayViewTest::SetUp();
        const std::string file = makeLog([](Log& log) {
            log.robots[0].robot = "a";
            log.robots.insert(log.robots.begin(), log.robots[0]);
            log.robots[0].robot = "b";
            for (Trajectory& trajectory : log.robots[0].trajectories) {
                const Nanoseconds begin = trajectory.poses.front().time;
                std::erase_if(trajectory.poses, [&](const StampedPose& stamped) {
                    const double at = toSeconds(stamped.time - begin);
                    return at > 0.8 && at < 2.2;
                });
                for (StampedPose& stamped : trajectory.poses) stamped.pose.y += 5;
            }
        });
        ASSERT_NO_FATAL_FAILURE(openLog(file, {RolloutPlan::Cut::every, 0, 1}));
        ASSERT_EQ(overlay.rollouts().world().robots().size(), 2u);
        ASSERT_EQ(window.shown()->frame->scene().robots.size(), 2u);
        ASSERT_GE(overlay.rollouts().requests().size(), 4u);
    }
    void next() {
        ASSERT_TRUE(overlay.shown().showNext(1));
        settleAll();
    }
};

TEST_F(AbsentRobotTest, SelectedRobotIsSelectedAgainWhereItComesBack) {
    field().setSelected(0);
    settleAll();
    const std::string name = window.shown()->frame->nameOf(0);
    next();
    ASSERT_EQ(window.shown()->frame->scene().robots.size(), 1u);
    EXPECT_FALSE(field().selected()) << "no other one in its place";
    while (window.shown()->frame->scene().robots.size() < 2) ASSERT_NO_FATAL_FAILURE(next());
    ASSERT_TRUE(field().selected());
    EXPECT_EQ(window.shown()->frame->nameOf(*field().selected()), name);
}

TEST_F(AbsentRobotTest, ConditionOnWhoIsAbsentIsLookedForInOtherRollouts) {
    const auto add = [&](const char* text) {
        const auto added = window.breakpointPanel().add(text);
        settleAll();
        return added ? "" : added.error().message();
    };
    ASSERT_NO_FATAL_FAILURE(next());
    ASSERT_EQ(window.shown()->frame->scene().robots.size(), 1u);
    const std::size_t absent = *overlay.rollouts().shown();
    EXPECT_THAT(add("robot[3].speed > 0"), HasSubstr("there is no robot 3: there are 2 robots"));
    EXPECT_EQ(add("time > 0.4 and robot[1].x > -1000"), "");
    const BreakpointState state = window.shown()->breakpoints.back();
    ASSERT_EQ(state.breakpoint.text, "time > 0.4 and robot[1].x > -1000");
    EXPECT_EQ(state.unfit, "there is no robot 1: there is robot 2 (at character 22)");
    EXPECT_TRUE(state.elsewhere);
    EXPECT_EQ(state.inRun, 0);
    QTest::keyClick(&window, Qt::Key_F6);
    settleAll();
    EXPECT_GT(*overlay.rollouts().shown(), absent);
    EXPECT_TRUE(window.shown()->breakpoints.back().here);
    EXPECT_FALSE(window.shown()->breakpoints.back().elsewhere);
    const std::string name = window.shown()->frame->nameOf(0);
    ASSERT_TRUE(overlay.shown().show(absent));
    settleAll();
    EXPECT_EQ(add(("contact " + name).c_str()), "");
    EXPECT_THAT(add("contact nobody"), HasSubstr("there is no body 'nobody'"));
}

TEST_F(OverlayViewTest, EscapeTakesBackOnlyWhatIsNotAccepted) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    window.activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    auto* length = panel.findChild<QDoubleSpinBox*>();
    const auto type = [&](const char* text, Qt::Key end) {
        length->setFocus();
        length->selectAll();
        QTest::keyClicks(length, text);
        QTest::keyClick(window.windowHandle(), end);
        settleAll();
    };
    type("3", Qt::Key_Return);
    ASSERT_EQ(overlay.rollouts().plan().length, 3);
    ASSERT_TRUE(length->hasFocus());
    QTest::keyClick(window.windowHandle(), Qt::Key_Escape);
    settleAll();
    EXPECT_EQ(overlay.rollouts().plan().length, 3);
    EXPECT_TRUE(window.field().hasFocus());
    type("4", Qt::Key_Return);
    type("7", Qt::Key_Escape);
    EXPECT_EQ(overlay.rollouts().plan().length, 4);
    EXPECT_EQ(length->value(), 4);
}

TEST_F(OverlayViewTest, KeyGoesToTheNextRolloutThatDiverges) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), {RolloutPlan::Cut::every, 0, 2}));
    // A bound that some rollouts keep, and others do not.
    std::vector<double> errors;
    for (const RolloutRow& row : overlay.rollouts().rows()) errors.push_back(row.position.value_or(0));
    std::sort(errors.begin(), errors.end());
    overlay.setBound({{1.5 * errors[errors.size() / 2], 10}, false});
    settleAll();
    const auto isLeft = [&](std::size_t rollout) {
        return overlay.rollouts().rowOf(rollout, 0)->divergence.has_value();
    };
    std::size_t from = 0;
    while (from + 1 < overlay.rollouts().requests().size() && (isLeft(from) || isLeft(from + 1))) ++from;
    ASSERT_LT(from + 2, overlay.rollouts().requests().size()) << "two in a row that are kept";
    ASSERT_TRUE(overlay.shown().show(from));
    settleAll();
    std::size_t wanted = from;
    do {
        wanted = (wanted + 1) % overlay.rollouts().requests().size();
    } while (!isLeft(wanted));
    QTest::keyClick(&window, Qt::Key_D);
    settleAll();
    EXPECT_EQ(overlay.rollouts().shown(), wanted);
    EXPECT_EQ(window.shown()->frame->scene().timeOf(state().tick),
              overlay.rollouts().rowOf(wanted, 0)->divergence->time);
    EXPECT_TRUE(field().selected());
    overlay.setBound({{100, 10}, false});
    settleAll();
    QTest::keyClick(&window, Qt::Key_D);
    settleAll();
    EXPECT_EQ(overlay.rollouts().shown(), wanted) << "none is left";
}

TEST_F(TwoRobotsTest, BreakOnDivergenceNamesAndSelectsTheOneThatLeaves) {
    QTest::keyClick(&window, Qt::Key_D, Qt::ShiftModifier);
    QTest::keyClick(&window, Qt::Key_F6);
    settleAll();
    EXPECT_EQ(window.shown()->tick(), leaves);
    EXPECT_THAT(window.shown()->message, HasSubstr(window.shown()->frame->nameOf(1) + " leaves"));
    EXPECT_EQ(overlay.rollouts().robot(), 1u);
}

TEST_F(TwoRobotsTest, SpeedsOfTheSelectedOneArePlottedByAKey) {
    QTest::keyClick(&window, Qt::Key_V, Qt::ShiftModifier);
    settleAll();
    const auto plotted = window.plots().plotted();
    for (const char* quantity : {"command_v", "v", "real_w"})
        EXPECT_EQ(plotted.count({quantity, window.shown()->frame->nameOf(0)}), 1u) << quantity;
    QTest::keyClick(&window, Qt::Key_V, Qt::ShiftModifier);
    settleAll();
    EXPECT_EQ(window.plots().plotted().count({"v", window.shown()->frame->nameOf(0)}), 0u);
}

TEST_F(OverlayViewTest, PanelBehindAnotherComesToTheFront) {
    ASSERT_NO_FATAL_FAILURE(openLog(shipped()));
    auto* breaks = window.findChild<QDockWidget*>("breakpoints");
    auto* reality = window.findChild<QDockWidget*>("reality");
    QApplication::processEvents();
    ASSERT_TRUE(breaks->visibleRegion().isEmpty());
    QTest::keyClick(&window, Qt::Key_F8);
    QApplication::processEvents();
    EXPECT_FALSE(breaks->visibleRegion().isEmpty());
    ASSERT_TRUE(reality->visibleRegion().isEmpty());
    reality->toggleViewAction()->trigger();
    QApplication::processEvents();
    EXPECT_FALSE(reality->visibleRegion().isEmpty());
    reality->toggleViewAction()->trigger();
    EXPECT_TRUE(reality->isHidden()) << "one that is in front goes away";
}

TEST_F(OverlayViewTest, RolloutsOfAStretchAreThoseOfCompare) {
    RolloutPlan plan{RolloutPlan::Cut::every, 1, 2};
    plan.stretch = 10;
    ASSERT_NO_FATAL_FAILURE(openLog(shipped(), plan));
    StretchOptions options;
    options.start = nanosecondsPerSecond;
    options.every = 2 * nanosecondsPerSecond;
    options.duration = 10 * nanosecondsPerSecond;
    const auto rollouts = rolloutsOf(overlay.rollouts().world(), options);
    ASSERT_TRUE(rollouts);
    ASSERT_EQ(overlay.rollouts().requests().size(), rollouts->size());
    EXPECT_EQ(rollouts->size(), 5 * overlay.rollouts().world().sessions().size());
    for (std::size_t i = 0; i < rollouts->size(); ++i)
        EXPECT_EQ(overlay.rollouts().requests()[i].start, (*rollouts)[i].start);
}

}  // namespace
}  // namespace mrose::gui
