// Which branches a run lists: their names, those that are undone, deleted and brought back.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debug/debugger.h"
#include "debug/run_recorder.h"
#include "recording/recording.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class BranchListTest : public testing::Test {
protected:
    BranchListTest() {
        OpenedRun run;
        run.setup = std::make_shared<const BranchSetup>(
            BranchSetup{{}, std::make_shared<const Scenario>(fieldScenario({.robots = 3}))});
        run.start = run.setup->scenario->initialState(7);
        debugger.open(run);
    }
    /// At a tick of the shown branch.
    void move(std::int64_t tick, std::size_t robot) {
        debugger.goTo(tick, false);
        const FieldFrame frame = frameOf(debugger.run());
        Pose pose = frame.poseOf(robot);
        pose.y += 0.1;
        ASSERT_TRUE(debugger.branchOff(moveBody(frame, robot, pose)));
    }
    std::vector<std::string> listed() {
        std::vector<std::string> names;
        for (const BranchInfo& branch : debugger.takeShown().branches)
            if (!branch.hidden) names.push_back(branch.name + (branch.undone ? ", undone" : ""));
        return names;
    }
    std::string name(std::size_t robot) const { return debugger.run().setup().scene().robots[robot].name; }
    std::string moved(std::size_t robot, const std::string& more = {}) const { return name(robot) + " moved" + more; }

    Debugger debugger;
};

TEST_F(BranchListTest, NamesAreNumberedWhereTheyAreTaken) {
    for (int i = 0; i < 3; ++i) {
        debugger.show(0, 0);
        move(40, 1);
    }
    EXPECT_THAT(listed(), ElementsAre("", moved(1), moved(1, " (2)"), moved(1, " (3)")));
}

TEST_F(BranchListTest, LineageIsThatOfTheTreeWithoutAnEnd) {
    move(40, 1);
    move(70, 2);
    debugger.stepBy(10);
    const Shown shown = debugger.takeShown();
    for (std::uint32_t branch = 0; branch < 3; ++branch) {
        std::vector<BranchTicks> expected = debugger.run().branches().parts(branch);
        ASSERT_EQ(expected.size(), branch + 1);
        expected.back().last = std::numeric_limits<std::int64_t>::max();
        EXPECT_EQ(shown.branches[branch].lineage, expected);
    }
}

TEST_F(BranchListTest, UndoneOnesGoWithTheNextEditAndCanBeBroughtBack) {
    for (int i = 0; i < 3; ++i) {
        move(40, 1);
        debugger.stepBy(10);
        debugger.undo();
        EXPECT_THAT(listed(), ElementsAre("", moved(1, ", undone")));
    }
    debugger.redo();
    EXPECT_THAT(listed(), ElementsAre("", moved(1)));
    EXPECT_EQ(debugger.run().last(), 50);
    debugger.restoreBranches();
    EXPECT_THAT(debugger.message(), HasSubstr("2 branches"));
    EXPECT_EQ(listed().size(), 4u);
}

TEST_F(BranchListTest, OneThatWasUndoneAndIsEditedStays) {
    move(40, 1);
    debugger.stepBy(10);
    const std::uint32_t undone = debugger.run().branch();
    debugger.undo();
    debugger.show(undone, 50);
    move(50, 2);
    EXPECT_THAT(listed(), ElementsAre("", moved(1), moved(2)));
}

TEST_F(BranchListTest, DeletedOnesGoWithAllThatDepartedFromThem) {
    move(40, 1);
    debugger.stepBy(10);
    const std::uint32_t first = debugger.run().branch();
    move(50, 2);
    debugger.stepBy(5);
    debugger.show(0, 30);
    move(30, 0);
    const std::uint32_t other = debugger.run().branch();
    debugger.show(first + 1, 55);
    debugger.removeBranch(first);
    EXPECT_EQ(debugger.run().branch(), 0u) << "the shown one is gone: its parent is shown";
    EXPECT_EQ(debugger.run().beside().value_or(other), other);
    EXPECT_THAT(listed(), ElementsAre("", moved(0)));
    for (const Ghost& ghost : frameOf(debugger.run()).ghosts) EXPECT_NE(ghost.name, moved(1));
    debugger.removeBranch(0);
    EXPECT_EQ(debugger.message(), "The run itself cannot be deleted");
    debugger.removeBranch(first);
    EXPECT_EQ(listed().size(), 2u) << "not twice";
    debugger.restoreBranches();
    EXPECT_THAT(listed(), ElementsAre("", moved(1), moved(2), moved(0)));
    debugger.show(first + 1, 55);
    EXPECT_EQ(debugger.run().tick(), 55) << "nothing of it was lost";
    debugger.removeOtherBranches();
    EXPECT_THAT(listed(), ElementsAre("", moved(1), moved(2)));
    EXPECT_FALSE(debugger.run().lastUndone());
}

TEST_F(BranchListTest, DeletedOnesAreNotSaved) {
    const TemporaryFolder folder;
    move(40, 1);
    debugger.stepBy(10);
    debugger.removeBranch(debugger.run().branch());
    debugger.goTo(60, false);
    move(60, 2);
    debugger.stepBy(10);
    const auto file = folder.path() / "a.mcap";
    ASSERT_TRUE(saveRun(file, debugger.run(), "", [](double) { return true; }));
    const auto recording = openRecording(file);
    ASSERT_TRUE(recording) << recording.error().message();
    ASSERT_EQ(recording->branches.size(), 2u);
    EXPECT_EQ(recording->branches[1].name, moved(2));
}

/// Its ticks are kept as they are: this program has not computed them.
TEST_F(BranchListTest, RecordingThatIsSavedAgainKeepsItsOrigin) {
    const TemporaryFolder folder;
    const auto originOf = [&](const std::optional<Origin>& opened) {
        OpenedRun run;
        run.setup = debugger.run().branches().record(0).setupPointer();
        run.start = run.setup->scenario->initialState(7);
        run.origin = opened;
        TimeTravel again(run, 1 << 20);
        const auto file = folder.path() / "a.mcap";
        EXPECT_TRUE(saveRun(file, again, "", [](double) { return true; }));
        return openRecording(file)->header.origin;
    };
    Origin other = thisOrigin();
    other.step = 1;
    other.commit = "abcdef";
    EXPECT_EQ(originOf(other), other);
    EXPECT_EQ(originOf({}), thisOrigin());
}

}  // namespace
}  // namespace mrose
