// Edits made one after the other, taken back and made again; and what a branch takes over from before it began.
#include <QAction>
#include <QTreeWidget>
#include <algorithm>

#include <gmock/gmock.h>

#include "debug/placement.h"
#include "debug/shown.h"
#include "frame/status_line.h"
#include "gui/window_fixture.h"
#include "panels/branch_panel.h"
#include "panels/command_panel.h"
#include "widgets/inspector.h"
#include "workflow/open_run.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

class BranchEditTest : public WindowTest {
protected:
    void seek(std::int64_t tick) {
        window.session().seek(tick);
        settle();
    }
    /// As by dragging it.
    void move(std::size_t body, double dx, double dy, double turn = 0) {
        Pose pose = window.shown()->frame->poseOf(body);
        pose.x += dx;
        pose.y += dy;
        pose.heading += turn;
        emit window.field().bodyMoved(body, pose);
        settle();
    }
    void undo() { key(Qt::Key_Z, Qt::ControlModifier); }
    void redo() { key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier); }
    std::string shownName() const { return window.shown()->branches[window.shown()->branch].name; }
    int listed() const { return listedBranches(window.shown()->branches); }
    std::string message() const { return window.shown()->message; }
};

/// All that is shown of what robots saw, decided and remember.
void expectSameMemories(const std::vector<RobotInsight>& found, const std::vector<RobotInsight>& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].tick, wanted[i].tick) << i;
        EXPECT_EQ(found[i].observed, wanted[i].observed) << i;
        EXPECT_EQ(found[i].decision.command, wanted[i].decision.command) << i;
        EXPECT_EQ(found[i].decision.annotations.size(), wanted[i].decision.annotations.size()) << i;
        EXPECT_EQ(found[i].memoryBefore, wanted[i].memoryBefore) << i;
    }
}

TEST_F(BranchEditTest, EditsAtOneTickAreOneBranchBesideTheOneItLeft) {
    seek(300);
    const StateHash before = window.shown()->hash;
    move(3, 0.3, 0);
    const StateHash one = window.shown()->hash;
    const std::vector<RobotInsight> memories = window.shown()->frame->insights;
    move(3, 0, 0.2);
    move(6, 0, 0, 0.5);
    const StateHash all = window.shown()->hash;
    EXPECT_EQ(shownName(), "red 4 moved, blue 3 turned");
    EXPECT_EQ(listed(), 2);
    EXPECT_EQ(window.shown()->branches[window.shown()->branch].parent, 0u);
    ASSERT_EQ(window.shown()->besideBranch, 0u);
    EXPECT_EQ(hashOf(window.shown()->beside->state), before);
    // One by one.
    undo();
    EXPECT_EQ(shownName(), "red 4 moved");
    EXPECT_EQ(window.shown()->besideBranch, 0u);
    undo();
    EXPECT_EQ(window.shown()->hash, one);
    expectSameMemories(window.shown()->frame->insights, memories);
    undo();
    EXPECT_EQ(window.shown()->hash, before);
    EXPECT_EQ(window.shown()->branch, 0u);
    EXPECT_EQ(listed(), 2);
    for (int i = 0; i < 3; ++i) redo();
    EXPECT_EQ(window.shown()->hash, all);
    EXPECT_EQ(window.shown()->besideBranch, 0u);
    EXPECT_EQ(listed(), 2);
    // What has been driven is left as it is.
    seek(320);
    move(0, 0.1, 0);
    EXPECT_EQ(listed(), 3);
    EXPECT_EQ(shownName(), "red 1 moved");
}

/// And after everything was driven, one by one as well.
TEST_F(BranchEditTest, UndoOfDrivenEditsShowsThoseBefore) {
    seek(300);
    move(3, 0.3, 0);
    const StateHash one = window.shown()->hash;
    move(6, 0.1, 0);
    const std::uint32_t both = window.shown()->branch;
    seek(340);
    undo();
    EXPECT_EQ(window.shown()->hash, one);
    redo();
    EXPECT_EQ(window.shown()->branch, both);
    EXPECT_EQ(window.shown()->last, 340);
}

TEST_F(BranchEditTest, MenuAndStatusSayWhatIsUndone) {
    const auto label = [&](const char* name) { return window.actions()[name].text().remove('&').toStdString(); };
    seek(200);
    EXPECT_EQ(label("undo"), "Undo");
    move(3, 0.3, 0);
    EXPECT_EQ(label("undo"), "Undo: red 4 moved");
    move(6, 0, 0, 0.5);
    EXPECT_EQ(label("undo"), "Undo: blue 3 turned");
    undo();
    EXPECT_EQ(label("undo"), "Undo: red 4 moved");
    EXPECT_EQ(label("redo"), "Redo: blue 3 turned");
    EXPECT_THAT(message(), HasSubstr("blue 3 turned"));
    undo();
    EXPECT_THAT(message(), HasSubstr("red 4 moved"));
    EXPECT_EQ(label("undo"), "Undo");
}

TEST_F(BranchEditTest, UndoOfACommandReturnsToWhereOneStood) {
    seek(100);
    window.field().setSelected(1);
    const std::int64_t decided = window.shown()->frame->insights[1].tick;
    const std::int64_t stood = decided + 3;
    seek(stood);
    ASSERT_EQ(window.shown()->frame->insights[1].tick, decided);
    window.commandPanel().apply();
    settle();
    EXPECT_EQ(state().tick, decided + 1);
    undo();
    EXPECT_EQ(state().tick, stood);
    EXPECT_EQ(window.shown()->branch, 0u);
    redo();
    EXPECT_EQ(state().tick, decided + 1);
    EXPECT_EQ(window.shown()->branch, 1u);
}

/// A robot that gets another command has observed and remembered as ever, whichever way one comes there.
TEST_F(BranchEditTest, ChangedCommandKeepsWhatTheControllerRemembered) {
    seek(100);
    window.field().setSelected(1);
    const std::int64_t decided = window.shown()->frame->insights[1].tick;
    seek(decided + 1);
    const RobotInsight thought = window.shown()->frame->insights[1];
    ASSERT_FALSE(thought.decision.annotations.empty());
    window.commandPanel().apply();
    settle();
    ASSERT_EQ(window.shown()->branch, 1u);
    const auto expectThought = [&] {
        const RobotInsight& shown = window.shown()->frame->insights[1];
        EXPECT_EQ(shown.tick, decided);
        ASSERT_EQ(shown.decision.annotations.size(), thought.decision.annotations.size());
        for (std::size_t i = 0; i < thought.decision.annotations.size(); ++i)
            EXPECT_EQ(shown.decision.annotations[i].label, thought.decision.annotations[i].label);
        EXPECT_TRUE(shown.observed);
        EXPECT_EQ(shown.memoryBefore, thought.memoryBefore);
    };
    expectThought();
    key(Qt::Key_Right);
    expectThought();
    seek(decided + 40);
    seek(decided + 1);
    expectThought();
}

/// Of a recording, too, whose branches may begin where their parents do.
TEST(BranchTravel, BackIsExactAtTheRootOfANestedBranch) {
    auto opened = openRun({"soccer.toml"});
    ASSERT_TRUE(opened);
    TimeTravel made(*opened);
    while (made.tick() < 61) ASSERT_TRUE(made.forward());
    const auto nudge = [](const Scenario&, WorldState& state) { state.robots[2].pose.x += 0.01; };
    ASSERT_TRUE(made.seek(60));
    const std::vector<RobotInsight> memories = frameOf(made).insights;
    ASSERT_TRUE(std::any_of(memories.begin(), memories.end(), [](const RobotInsight& one) { return one.tick >= 0; }));
    ASSERT_TRUE(made.branchOff({"one", {}, nudge}));
    ASSERT_TRUE(made.branchOff({"two", {}, nudge}));
    OpenedRun nested = *opened;
    for (std::uint32_t i = 0; i < made.branches().size(); ++i) {
        Branch branch = made.branches()[i];
        if (i == 2) branch.parent = 1;
        auto start = Playback(*opened->setup->scenario).reach(branch.timeline, branch.timeline.first());
        nested.branches.push_back({branch, opened->setup, start->state});
    }
    TimeTravel run(nested);
    ASSERT_TRUE(run.show(2, 60));
    ASSERT_EQ(run.owner(), 2u);
    expectSameMemories(frameOf(run).insights, memories);
}

/// Contacts do not begin anew because a branch begins.
TEST(BranchTravel, ContactsThatGoOnAreNotCountedAgain) {
    const auto opened = openRun({"soccer.toml"});
    ASSERT_TRUE(opened);
    TimeTravel run(*opened);
    const auto contacts = [](const BranchRecord& record, std::int64_t from, std::int64_t to) {
        return std::count_if(record.marks().begin(), record.marks().end(), [&](const TimelineMark& mark) {
            return mark.kind == TimelineMark::Kind::contact && mark.tick > from && mark.tick <= to;
        });
    };
    // Two that touch on for a while: where a pair touches that has done so before.
    std::int64_t touching = 0;
    while (touching == 0 && run.tick() < 3000) {
        ASSERT_TRUE(run.forward());
        if (run.tick() > 5 && !run.cursor().trace()->contacts.empty() &&
            contacts(run.branches().record(0), run.tick() - 1, run.tick()) == 0)
            touching = run.tick();
    }
    ASSERT_GT(touching, 0);
    const std::int64_t root = touching - 1;
    for (int i = 0; i < 40; ++i) ASSERT_TRUE(run.forward());
    ASSERT_TRUE(run.seek(root));
    ASSERT_TRUE(run.branchOff({"the same", {}, [](const Scenario&, WorldState&) {}}));
    while (run.tick() < root + 40) ASSERT_TRUE(run.forward());
    EXPECT_EQ(contacts(run.branches().record(1), root, root + 40), contacts(run.branches().record(0), root, root + 40));
    // Opened from a file it is the same.
    OpenedRun file = *opened;
    for (std::uint32_t i = 0; i < run.branches().size(); ++i) {
        const Branch& branch = run.branches()[i];
        auto start = Playback(*opened->setup->scenario).reach(branch.timeline, branch.timeline.first());
        file.branches.push_back({branch, opened->setup, start->state});
    }
    TimeTravel again(file);
    while (*again.branches().learn(1000)) {
    }
    EXPECT_EQ(again.branches().record(1).marks(), run.branches().record(1).marks());
}

TEST_F(BranchEditTest, BranchThatBeginsNearTheEndPlaysOn) {
    const Scene& scene = window.shown()->frame->scene();
    const std::int64_t end = scene.ticksOf(window.shown()->setup->scenario->parts().duration);
    seek(end - 5);
    move(3, 0.2, 0);
    window.session().setSpeed(0);
    window.session().play();
    const std::int64_t wanted = end - 5 + scene.ticksOf(10 * nanosecondsPerSecond);
    ASSERT_TRUE(QTest::qWaitFor([&] { return state().tick > end && !window.shown()->playing; }, 60'000));
    EXPECT_EQ(state().tick, wanted);
    EXPECT_THAT(message(), HasSubstr("10 s of this branch"));
}

TEST_F(BranchEditTest, DeleteInTheListDeletesABranch) {
    seek(300);
    move(3, 0.3, 0);
    seek(320);
    auto* list = window.branchPanel().findChild<QTreeWidget*>();
    list->setFocus();
    ASSERT_EQ(list->currentItem()->text(0), "red 4 moved");
    QTest::keyClick(list, Qt::Key_Delete);
    settle();
    EXPECT_EQ(listed(), 1);
    EXPECT_EQ(window.shown()->branch, 0u);
    EXPECT_EQ(message(), "Deleted: red 4 moved, with what departed from it");
    EXPECT_TRUE(window.field().layers().has(FieldLayer::ghosts));
    EXPECT_TRUE(window.shown()->frame->ghosts.empty());
    window.actions()["restore_branches"].trigger();
    settle();
    EXPECT_EQ(listed(), 2);
    window.actions()["delete_other_branches"].trigger();
    settle();
    EXPECT_EQ(listed(), 1);
}

TEST_F(BranchEditTest, DifferencesAndValuesAreSeenInWholeRows) {
    seek(300);
    window.field().setSelected(3);
    move(3, 0.3, 0);
    seek(320);
    QList<QTreeWidget*> trees = window.branchPanel().findChildren<QTreeWidget*>();
    trees << window.inspector().findChild<QTreeWidget*>();
    ASSERT_EQ(trees.size(), 3);
    for (QTreeWidget* tree : trees)
        for (int height = 60; height < 80; ++height) {
            tree->setFixedHeight(height);
            QApplication::processEvents();
            const int bottom = tree->viewport()->height() - 1;
            const QModelIndex last = tree->indexAt({30, bottom});
            EXPECT_TRUE(!last.isValid() || tree->visualRect(last).bottom() <= bottom)
                << tree->accessibleName().toStdString() << ' ' << height;
        }
}

TEST_F(BranchEditTest, ListOffersWhatCanBeDoneWithTheChosenBranch) {
    auto* list = window.branchPanel().findChild<QTreeWidget*>();
    const auto offered = [&] {
        QStringList texts;
        for (const QAction* action : list->actions())
            if (action->isEnabled()) texts << action->text();
        return texts.join(", ").toStdString();
    };
    const auto choose = [&](const char* name) {
        list->setCurrentItem(list->findItems(name, Qt::MatchExactly | Qt::MatchRecursive).value(0));
    };
    EXPECT_EQ(offered(), "Rename") << "of the run alone";
    seek(300);
    move(3, 0.3, 0);
    seek(320);
    move(2, 0.3, 0);
    EXPECT_EQ(offered(), "Rename, Delete") << "of the one that is shown";
    choose("red 4 moved");
    EXPECT_EQ(offered(), "Show, Rename, Delete") << "compared with the shown one already";
    choose("the run");
    EXPECT_EQ(offered(), "Show, Compare with the shown one, Rename");
    const std::string before = message();
    list->setFocus();
    QTest::keyClick(list, Qt::Key_Delete);
    settle();
    EXPECT_EQ(message(), before);
    EXPECT_EQ(listed(), 3);
    // One without a name keeps the one that it has.
    list->currentItem()->setText(0, " ");
    EXPECT_EQ(list->currentItem()->text(0), "the run");
}

TEST_F(BranchEditTest, BodiesThatAreDroppedOnOthersAreSetBesideThem) {
    seek(300);
    const Pose on = window.shown()->frame->poseOf(1);
    emit window.field().bodyMoved(0, on);
    settle();
    EXPECT_THAT(message(), HasSubstr("where it was put it would have stood on red 2"));
    EXPECT_EQ(hindranceAt(*window.shown()->frame, 0, window.shown()->frame->poseOf(0)), "");
    emit window.field().bodyMoved(0, {1000, 0, 0});
    settle();
    EXPECT_EQ(listed(), 2);
    EXPECT_THAT(window.frame().status.said().toStdString(), HasSubstr("stays where it was"));
}

}  // namespace
}  // namespace mrose::gui
