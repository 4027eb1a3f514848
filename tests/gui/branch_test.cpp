#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPushButton>
#include <QTreeWidget>
#include <algorithm>

#include "gui/window_fixture.h"
#include "panels/branch_panel.h"
#include "panels/command_panel.h"
#include "panels/side_view.h"
#include "scenario/carry_over.h"
#include "support/places.h"
#include "widgets/qt_text.h"
#include "workflow/open_run.h"
#include "world/state_hash.h"

namespace mrose::gui {
namespace {

class BranchTest : public WindowTest {
protected:
    void seek(std::int64_t tick) {
        window.session().seek(tick);
        settle();
    }
    std::int64_t firstKick() const {
        for (const TimelineMark& mark : *window.shown()->marks)
            if (mark.kind == TimelineMark::Kind::kick) return mark.tick;
        return -1;
    }
};

/// What a run of the core alone gives, with one robot told from outside.
WorldState runAlone(const Scenario& scenario, std::int64_t ticks, std::uint32_t robot, std::int64_t from,
                    const std::function<void(Decision&)>& change) {
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    while (state.tick < ticks) {
        std::vector<RobotDecision> told;
        if (state.tick == from) {
            // It sees and thinks as ever, and is told something else.
            const WorldState after = stepped(scenario, state);
            std::ranges::copy(scenario.memoryOf(after, robot), scenario.memoryOf(state, robot).begin());
            std::ranges::copy(scenario.sensorMemory(after, robot), scenario.sensorMemory(state, robot).begin());
            change(told.emplace_back(RobotDecision{robot, {}}).decision);
        }
        step(scenario, state, buffers, {told});
    }
    return state;
}

TEST_F(BranchTest, CommandBehindTheFirstKickIsFoundAndChanged) {
    const std::shared_ptr<const Scenario> scenario = window.shown()->frame->scenario;
    seek(600);
    const std::int64_t kicked = firstKick();
    ASSERT_GT(kicked, 0);
    seek(kicked + 3);
    key(Qt::Key_K);
    ASSERT_TRUE(window.field().selected());
    const auto robot = static_cast<std::uint32_t>(*window.field().selected());
    const RobotInsight& insight = window.shown()->frame->insights[robot];
    // Its decision holds the kick, and the dead time lies between it and the kick.
    ASSERT_EQ(insight.tick, state().tick - 1);
    ASSERT_EQ(insight.decision.kicks.size(), 1u);
    const Scene& scene = scenario->scene();
    const Nanoseconds due =
        scene.timeOf(insight.tick) + scene.typeOf(robot).manipulators[insight.decision.kicks[0].manipulator].deadTime;
    EXPECT_TRUE(scene.timeOf(kicked - 1) <= due && due < scene.timeOf(kicked));

    const std::int64_t decided = insight.tick;
    const Command command = insight.decision.command.value_or(Command{});
    auto* kick = window.commandPanel().findChild<QComboBox*>();
    kick->setCurrentIndex(0);
    key(Qt::Key_Return, Qt::ControlModifier);
    EXPECT_EQ(window.shown()->branches.size(), 2u);
    EXPECT_EQ(window.shown()->branch, 1u);
    EXPECT_EQ(state().tick, decided + 1);
    EXPECT_EQ(QApplication::focusWidget(), &window.field());
    seek(kicked + 100);
    const WorldState expected =
        runAlone(*scenario, kicked + 100, robot, decided, [&](Decision& d) { d.command = command; });
    EXPECT_EQ(window.shown()->hash, hashOf(expected));
    // The run goes on beside it, as it would have without.
    ASSERT_NE(window.shown()->beside, nullptr);
    const WorldState untouched = runAlone(*scenario, kicked + 100, 0, -1, {});
    EXPECT_EQ(hashOf(window.shown()->beside->state), hashOf(untouched));
    EXPECT_NE(window.shown()->hash, hashOf(untouched));
}

TEST_F(BranchTest, TypedCommandIsTold) {
    const std::shared_ptr<const Scenario> scenario = window.shown()->frame->scenario;
    seek(100);
    window.field().setSelected(1);
    const std::int64_t decided = window.shown()->frame->insights[1].tick;
    const auto boxes = window.commandPanel().findChildren<QDoubleSpinBox*>();
    key(Qt::Key_E);
    ASSERT_EQ(QApplication::focusWidget(), boxes[0]);
    QTest::keyClicks(boxes[0], "-0.25");
    boxes[1]->setValue(1.25);
    QTest::mouseClick(window.commandPanel().findChild<QPushButton*>(), Qt::LeftButton);
    settle();
    seek(200);
    const WorldState expected = runAlone(*scenario, 200, 1, decided, [](Decision& decision) {
        decision.command = Command{-0.25, 1.25};
    });
    EXPECT_EQ(window.shown()->hash, hashOf(expected));
}

/// Return in a field will do, and the branch is called by what was changed.
TEST_F(BranchTest, ReturnTriesTheTypedCommand) {
    seek(100);
    window.field().setSelected(1);
    const auto boxes = window.commandPanel().findChildren<QDoubleSpinBox*>();
    key(Qt::Key_E);
    QTest::keyClicks(boxes[0], "-0.25");
    EXPECT_EQ(window.shown()->branches.size(), 1u);
    QTest::keyClick(boxes[0], Qt::Key_Return);
    settle();
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    EXPECT_EQ(window.shown()->branches[1].name, "red 2: -0.25 m/s");
    EXPECT_TRUE(qtText(window.shown()->message).contains("Space plays it")) << window.shown()->message;
}

TEST_F(BranchTest, CommandThatIsNotChangedChangesNothing) {
    const std::shared_ptr<const Scenario> scenario = window.shown()->frame->scenario;
    seek(333);
    window.field().setSelected(2);
    window.commandPanel().apply();
    settle();
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    seek(700);
    EXPECT_EQ(window.shown()->hash, hashOf(runAlone(*scenario, 700, 0, -1, {})));
}

TEST_F(BranchTest, UndoAndRedoGoThereAndBack) {
    seek(200);
    const StateHash before = window.shown()->hash;
    drag(pixelOf(8), pixelOf(8) + QPointF(25, 25));
    const StateHash moved = window.shown()->hash;
    seek(260);
    key(Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(window.shown()->hash, before);
    EXPECT_FALSE(window.shown()->canUndo);
    key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    EXPECT_EQ(window.shown()->hash, moved);
    EXPECT_FALSE(window.shown()->canRedo);
}

TEST_F(BranchTest, RestartWithASeedIsTheRunOfThatSeed) {
    seek(50);
    ASSERT_TRUE(window.actions().perform("restart_with_seed", QString("42")));
    settle();
    EXPECT_EQ(state().tick, 0);
    seek(120);
    const Scenario& scenario = *window.shown()->frame->scenario;
    WorldState expected = scenario.initialState(42);
    StepBuffers buffers;
    while (expected.tick < 120) step(scenario, expected, buffers);
    EXPECT_EQ(window.shown()->hash, hashOf(expected));
    EXPECT_FALSE(window.actions().perform("restart_with_seed", QString("-3")));
    EXPECT_FALSE(window.actions().perform("restart_with_seed", QString("seven")));
}

TEST_F(BranchTest, LineageGoesBackBeyondTheBranchsBeginning) {
    const Scenario& scenario = *window.shown()->frame->scenario;
    seek(200);
    drag(pixelOf(8), pixelOf(8) + QPointF(25, 25));
    seek(230);
    const StateHash later = window.shown()->hash;
    seek(150);
    EXPECT_EQ(window.shown()->branch, 1u);
    EXPECT_EQ(window.shown()->first, 0);
    EXPECT_EQ(window.shown()->hash, hashOf(runAlone(scenario, 150, 0, -1, {})));
    for (int i = 0; i < 80; ++i) window.session().stepBy(1);
    settle();
    EXPECT_EQ(state().tick, 230);
    EXPECT_EQ(window.shown()->hash, later);
    // What is changed before its beginning departs from the run.
    seek(100);
    drag(pixelOf(8), pixelOf(8) + QPointF(-25, 0));
    EXPECT_EQ(window.shown()->branches[2].parent, 0u);
}

TEST_F(BranchTest, MarksAreThoseOfTheWholeLineage) {
    seek(400);
    const std::vector<TimelineMark> before = *window.shown()->marks;
    drag(pixelOf(8), pixelOf(8) + QPointF(25, 25));
    EXPECT_EQ(*window.shown()->marks, before);
    seek(600);
    const std::vector<TimelineMark>& after = *window.shown()->marks;
    ASSERT_GT(after.size(), before.size());
    EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin()));
    EXPECT_TRUE(std::is_sorted(after.begin(), after.end(),
                               [](const TimelineMark& a, const TimelineMark& b) { return a.tick < b.tick; }));
}

TEST_F(BranchTest, ScrubbingDraggingAndUndoingLeaveTheRunAsItIs) {
    const Scenario& scenario = *window.shown()->frame->scenario;
    for (const std::int64_t tick : {300, 17, 299, 0, 150}) seek(tick);
    drag(pixelOf(0), pixelOf(0) + QPointF(10, 40));
    seek(400);
    key(Qt::Key_Left);
    key(Qt::Key_Z, Qt::ControlModifier);
    drag(pixelOf(3), pixelOf(3) + QPointF(0, 30), Qt::RightButton);
    seek(350);
    window.session().show(0, 350);
    settle();
    seek(500);
    const WorldState expected = runAlone(scenario, 500, 0, -1, {});
    EXPECT_EQ(window.shown()->hash, hashOf(expected));
    EXPECT_EQ(window.shown()->branches.size(), 3u);
}

TEST_F(BranchTest, SwappedModelIsThatOfAScenarioThatNamesIt) {
    seek(150);
    EXPECT_FALSE(window.actions().perform("swap_model", QString("nothing.net")));
    const std::string net = (sourceFolder() / "nets/pioneer.net").string();
    EXPECT_FALSE(window.actions().perform("swap_model", qtText(net))) << "no robot is selected";
    const auto before = window.shown()->setup;
    window.field().setSelected(5);
    ASSERT_TRUE(window.actions().perform("swap_model", qtText(net)));
    settle();
    EXPECT_EQ(window.shown()->branches[1].name, "blue 2 moves by pioneer.net");
    EXPECT_EQ(state().tick, 150);
    const Scenario& swapped = *window.shown()->setup->scenario;
    // Its kinematics are replaced; all others move as they did.
    for (std::size_t i = 0; i < 8; ++i) {
        const bool same = swapped.scene().modelOf(i).deadTimes().v == before->scene().modelOf(i).deadTimes().v;
        EXPECT_EQ(same, i != 5) << i;
    }
    WorldState expected = runAlone(*before->scenario, 150, 0, -1, {});
    expected = carriedOver(*before->scenario, expected, swapped);
    StepBuffers buffers;
    while (expected.tick < 250) step(swapped, expected, buffers);
    seek(250);
    EXPECT_EQ(window.shown()->hash, hashOf(expected));
    ASSERT_NE(window.shown()->beside, nullptr);
    EXPECT_EQ(hashOf(window.shown()->beside->state), hashOf(runAlone(*before->scenario, 250, 0, -1, {})));
}

TEST_F(BranchTest, PanelListsNamesAndComparesBranches) {
    seek(100);
    const QPointF at = pixelOf(8);
    drag(at, at + QPointF(0, -60));
    auto trees = window.branchPanel().findChildren<QTreeWidget*>();
    QTreeWidget* list = trees[0];
    ASSERT_EQ(list->topLevelItemCount(), 1);
    ASSERT_EQ(list->topLevelItem(0)->childCount(), 1);
    EXPECT_EQ(list->topLevelItem(0)->child(0)->text(0), "ball moved");
    list->topLevelItem(0)->child(0)->setText(0, "ball farther up");
    settle();
    EXPECT_EQ(window.shown()->branches[1].name, "ball farther up");
    // The ball lies 60 pixels off.
    const double apart = 60 / window.field().transform().scale();
    const QList<QTreeWidgetItem*> rows = trees[1]->findItems("ball apart", Qt::MatchExactly);
    ASSERT_EQ(rows.size(), 1);
    EXPECT_EQ(rows[0]->text(1), QString::number(100 * apart, 'f', 1) + " cm");
    EXPECT_EQ(trees[1]->findItems("red 1 apart", Qt::MatchExactly)[0]->text(1), "same");
    QTest::mouseClick(list->viewport(), Qt::LeftButton, Qt::NoModifier,
                      list->visualItemRect(list->topLevelItem(0)).center());
    settle();
    EXPECT_EQ(window.shown()->branch, 0u);
    EXPECT_EQ(window.shown()->besideBranch, 1u);
    EXPECT_EQ(pixelOf(8), at);
}

TEST_F(BranchTest, WhatLiesBesideGoesOn) {
    const Scenario& scenario = *window.shown()->frame->scenario;
    seek(100);
    drag(pixelOf(8), pixelOf(8) + QPointF(0, -60));
    key(Qt::Key_Z, Qt::ControlModifier);
    ASSERT_EQ(window.shown()->branches[1].last, 100);
    seek(180);
    ASSERT_EQ(window.shown()->besideBranch, 1u);
    EXPECT_EQ(window.shown()->beside->state.tick, 180);
    EXPECT_EQ(window.shown()->hash, hashOf(runAlone(scenario, 180, 0, -1, {})));
    WorldState expected = runAlone(scenario, 100, 0, -1, {});
    expected.objects[0].pose.y += 60 / window.field().transform().scale();
    expected.objects[0].velocity_W = {};
    expected.objects[0].roll_W = {};
    StepBuffers buffers;
    while (expected.tick < 180) step(scenario, expected, buffers);
    EXPECT_NEAR(window.shown()->beside->state.objects[0].pose.y, expected.objects[0].pose.y, 1e-6);
}

TEST_F(BranchTest, ChoosingABranchThatEndsEarlierSaysSo) {
    seek(100);
    drag(pixelOf(8), pixelOf(8) + QPointF(40, 0));
    seek(150);
    key(Qt::Key_Z, Qt::ControlModifier);
    seek(100);
    window.session().show(1, 300);
    settle();
    EXPECT_EQ(state().tick, 150);
    EXPECT_TRUE(qtText(window.shown()->message).contains("6.00 s") &&
                qtText(window.shown()->message).contains("3.00 s"))
        << window.shown()->message;
    window.session().show(1, 120);
    settle();
    EXPECT_EQ(qtText(window.shown()->message), QString());
}

/// Of all branches together, whatever was played in which.
TEST_F(BranchTest, TracksOfAllBranchesShareTheirRoom) {
    const auto opened = openRun({"soccer.toml"});
    ASSERT_TRUE(opened);
    constexpr std::size_t most = 100'000;
    TimeTravel whole(*opened), limited(*opened, most);
    for (int branch = 0; branch < 3; ++branch) {
        for (TimeTravel* run : {&whole, &limited}) {
            ASSERT_TRUE(run->branchOff({"more noise", {}, [](const Scenario&, WorldState& state) { ++state.seed; }}));
            for (int i = 0; i < 400; ++i) ASSERT_TRUE(run->forward());
            ASSERT_TRUE(run->seek(run->tick() - 100));
        }
        EXPECT_LE(limited.branches().trackBytes(), most);
    }
    EXPECT_GT(whole.branches().trackBytes(), most);
    // What is kept is the newest, and as it was.
    const PoseTrack &all = whole.branches().record(3).track(), &kept = limited.branches().record(3).track();
    EXPECT_GT(kept.first(), all.first());
    EXPECT_EQ(kept.last(), all.last());
    EXPECT_EQ(kept.posesAt(kept.first()), all.posesAt(kept.first()));
    EXPECT_EQ(kept.posesAt(kept.last()), all.posesAt(kept.last()));
    EXPECT_EQ(hashOf(limited.state()), hashOf(whole.state()));
}

TEST_F(BranchTest, PlayingStopsWhereTheScenarioEndsAndGoesOnWhenAsked) {
    const Scenario& scenario = *window.shown()->frame->scenario;
    const std::int64_t end = scenario.scene().ticksOf(scenario.parts().duration);
    seek(end - 5);
    window.session().setSpeed(0);
    window.session().play();
    ASSERT_TRUE(QTest::qWaitFor([&] { return state().tick >= end && !window.shown()->playing; }));
    EXPECT_EQ(state().tick, end);
    EXPECT_TRUE(qtText(window.shown()->message).contains("60 s are over"));
    window.session().play();
    EXPECT_TRUE(QTest::qWaitFor([&] { return state().tick > end; }));
    window.session().pause();
    settle();
}

TEST_F(BranchTest, BothBranchesAreSeenSideBySide) {
    seek(100);
    window.field().setLayers(FieldLayers::none());
    drag(pixelOf(8), pixelOf(8) + QPointF(40, 0));
    EXPECT_FALSE(window.view().beside().isVisible());
    key(Qt::Key_S);
    ASSERT_TRUE(window.view().beside().isVisible());
    const auto ballPixel = [&](FieldView& field, const Pose& ball) {
        return field.grab().toImage().pixelColor(field.transform().toPixels({ball.x, ball.y}).toPoint());
    };
    const Pose here = state().objects[0].pose, there = window.shown()->beside->state.objects[0].pose;
    EXPECT_NEAR(window.field().transform().scale(), window.view().beside().transform().scale(), 1e-9);
    const QColor ball = ballPixel(window.field(), here);
    EXPECT_EQ(ballPixel(window.view().beside(), there), ball);
    EXPECT_NE(ballPixel(window.view().beside(), here), ball);
    window.field().viewport().zoom(2);
    window.field().grab();
    EXPECT_NEAR(window.field().transform().scale(), window.view().beside().transform().scale(), 1e-9);
}

TEST_F(BranchTest, SideBySideStaysOffUntilThereIsAnotherBranch) {
    QAction& sideBySide = window.actions()["side_by_side"];
    seek(100);
    key(Qt::Key_S);
    EXPECT_FALSE(sideBySide.isChecked());
    drag(pixelOf(2), pixelOf(2) + QPointF(30, 20));
    ASSERT_EQ(window.shown()->branches.size(), 2u);
    EXPECT_FALSE(window.view().beside().isVisible()) << "what was asked for in vain does not come later";
    key(Qt::Key_S);
    EXPECT_TRUE(sideBySide.isChecked());
    EXPECT_TRUE(window.view().beside().isVisible());
    ASSERT_TRUE(window.open("soccer.toml"));
    settle();
    EXPECT_FALSE(sideBySide.isChecked());
}

TEST_F(BranchTest, HomeGoesToWhereTheBranchBeginsAndThenToTheRunsStart) {
    seek(200);
    drag(pixelOf(2), pixelOf(2) + QPointF(30, 20));
    const std::int64_t departed = window.shown()->branches[1].departed;
    ASSERT_EQ(departed, 200);
    for (int i = 0; i < 5; ++i) window.session().stepBy(10);
    settle();
    key(Qt::Key_Home);
    EXPECT_EQ(state().tick, departed);
    EXPECT_EQ(window.shown()->branch, 1u);
    key(Qt::Key_Home);
    EXPECT_EQ(state().tick, 0);
    key(Qt::Key_Home);
    EXPECT_EQ(state().tick, departed) << "there and back";
    key(Qt::Key_Home, Qt::ControlModifier);
    EXPECT_EQ(state().tick, 0);
    EXPECT_EQ(window.shown()->branch, 0u);
    seek(150);
    key(Qt::Key_Home);
    EXPECT_EQ(state().tick, 0);
}

TEST_F(BranchTest, TheCauseOfAKickIsShownFromNearBy) {
    seek(600);
    const std::int64_t kicked = firstKick();
    ASSERT_GT(kicked, 0);
    seek(kicked + 3);
    const double fitted = window.field().transform().scale();
    key(Qt::Key_K);
    const std::size_t ball = window.shown()->frame->state.robots.size();
    const ViewTransform near = window.field().transform();
    EXPECT_GT(near.scale(), 1.2 * fitted);
    const QRectF view = window.field().rect();
    for (const std::size_t body : {*window.field().selected(), ball}) {
        const double margin = 1.9 * near.scale();
        EXPECT_TRUE(view.adjusted(margin, margin, -margin, -margin).contains(pixelOf(body))) << body;
    }
    // Another way of seeing both well is the user's own choice.
    window.field().viewport().zoom(1.1);
    const ViewTransform own = window.field().transform();
    key(Qt::Key_K);
    EXPECT_TRUE(window.field().transform() == own);
}

}  // namespace
}  // namespace mrose::gui
