#include <algorithm>

#include <gmock/gmock.h>

#include "files/window_files.h"
#include "gui/rollout_fixture.h"
#include "widgets/message_bar.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

class RolloutBreaksTest : public RolloutTest {
protected:
    /// The simulated robot of a rollout as compare() has it, at its start and after each step.
    std::vector<Pose> posesOf(std::size_t rollout) const {
        for (const ComparedRollout& compared : overlay.rollouts().comparison()->rollouts) {
            if (compared.request != rollout || compared.use == RolloutUse::absent) continue;
            std::vector<Pose> poses{compared.real.truth.front()};
            poses.insert(poses.end(), compared.simulated.begin(), compared.simulated.end());
            return poses;
        }
        return {};
    }
    /// The first step within which its x comes to exceed a threshold; 0: none.
    std::size_t crossing(std::size_t rollout, double threshold) const {
        const std::vector<Pose> poses = posesOf(rollout);
        for (std::size_t k = 1; k < poses.size(); ++k)
            if (poses[k - 1].x <= threshold && poses[k].x > threshold) return k;
        return 0;
    }
    /// One that no rollout before `from` crosses, but one after it.
    double thresholdAfter(std::size_t from) const {
        double highest = -1e9;
        for (std::size_t rollout = 0; rollout < overlay.rollouts().requests().size(); ++rollout) {
            double least = 1e9, most = -1e9;
            for (const Pose& pose : posesOf(rollout)) {
                least = std::min(least, pose.x);
                most = std::max(most, pose.x);
            }
            if (rollout >= from && most > highest + 0.1 && least < most - 0.05)
                return std::max(highest, least) / 2 + most / 2;
            highest = std::max(highest, most);
        }
        return highest + 1;
    }
};

TEST_F(RolloutBreaksTest, NextBreakIsFoundInARolloutFurtherOnAndTheLastInOneBefore) {
    const double threshold = thresholdAfter(3);
    std::size_t expected = 1;
    while (expected < overlay.rollouts().requests().size() && crossing(expected, threshold) == 0) ++expected;
    ASSERT_LT(expected, overlay.rollouts().requests().size()) << "a log in which x grows later on";
    stopOn("robot[1].x > " + std::to_string(threshold));
    press();
    EXPECT_EQ(shownRollout(), expected);
    EXPECT_TRUE(window.shown()->atBreak);
    const auto step = static_cast<double>(crossing(expected, threshold));
    EXPECT_GT(window.shown()->tick(), ticksOf(0.1 * (step - 1)));
    EXPECT_LE(window.shown()->tick(), ticksOf(0.1 * step));
    const std::int64_t tick = window.shown()->tick();
    EXPECT_GT(state().robots[0].pose.x, threshold);

    // Back from the end at the same places, each once.
    std::vector<std::pair<std::size_t, std::int64_t>> stops{{expected, tick}}, back;
    const auto place = [&] { return std::pair(shownRollout(), window.shown()->tick()); };
    while (press(), window.shown()->atBreak && place() != stops.back()) stops.push_back(place());
    open(overlay.rollouts().requests().size() - 1);
    window.session().seek(ticksOf(2));
    settleAll();
    for (std::size_t i = 0; i < stops.size() + 2; ++i) {
        press(Qt::ShiftModifier);
        if (!window.shown()->atBreak || (!back.empty() && place() == back.front())) break;
        back.insert(back.begin(), place());
    }
    EXPECT_EQ(back, stops);
    EXPECT_EQ(window.shown()->breakpoints.size(), 1u) << "they go along";
}

TEST_F(RolloutBreaksTest, NoBreakAnywhereLeavesTheShownTick) {
    stopOn("robot[1].x > 1000");
    open(2);
    const auto stays = [&](double seconds, Qt::KeyboardModifiers modifiers, const char* none) {
        window.session().seek(ticksOf(seconds));
        settleAll();
        press(modifiers);
        EXPECT_EQ(shownRollout(), 2u);
        EXPECT_EQ(window.shown()->tick(), ticksOf(seconds));
        EXPECT_FALSE(window.shown()->atBreak);
        EXPECT_THAT(said(), HasSubstr(none));
    };
    const char *after = "nor in those after it", *before = "nor in those before it";
    stays(0.5, Qt::NoModifier, after);
    EXPECT_EQ(window.shown()->last, ticksOf(2)) << "as far as the rollout goes";
    stays(0.3, Qt::NoModifier, after);
    EXPECT_EQ(window.shown()->last, ticksOf(2));
    stays(2, Qt::NoModifier, after);
    stays(1.1, Qt::ShiftModifier, before);
    open(0);
    press(Qt::ShiftModifier);
    EXPECT_EQ(shownRollout(), 0u);
    EXPECT_EQ(window.shown()->tick(), 0);
}

/// What lies beyond a rollout's end, where its robots get no commands any more, is no part of the log.
TEST_F(RolloutBreaksTest, BreakBeyondTheRolloutsEndIsNone) {
    window.session().seek(ticksOf(3));
    settleAll();
    window.session().seek(ticksOf(1));
    stopOn("time > 2.5");
    press();
    EXPECT_EQ(shownRollout(), 0u);
    EXPECT_EQ(window.shown()->tick(), ticksOf(1));
}

TEST_F(RolloutBreaksTest, DivergencesOfAllRolloutsAreGoneThroughInTheirOrder) {
    RolloutPlan plan{RolloutPlan::Cut::every, 0, 2};
    ASSERT_TRUE(overlay.setPlan(plan));
    overlay.setBound({{0.01, 0.5}, false});
    settleAll();
    std::vector<std::pair<std::size_t, std::int64_t>> expected, found;
    for (const RolloutRow& row : overlay.rollouts().rows())
        if (row.divergence)
            expected.emplace_back(row.rollout, window.shown()->frame->scene().ticksOf(row.divergence->time));
    ASSERT_GE(expected.size(), 3u);
    stopOn("divergence");
    for (std::size_t i = 0; i <= expected.size(); ++i) {
        press();
        if (!window.shown()->atBreak) break;
        found.emplace_back(shownRollout(), window.shown()->tick());
    }
    EXPECT_EQ(found, expected);
    open(overlay.rollouts().requests().size() - 1);
    QTest::keyClick(&window, Qt::Key_Home);
    settleAll();
    std::vector<std::pair<std::size_t, std::int64_t>> back;
    for (std::size_t i = 0; i <= expected.size(); ++i) {
        press(Qt::ShiftModifier);
        if (!window.shown()->atBreak) break;
        back.insert(back.begin(), {shownRollout(), window.shown()->tick()});
    }
    std::erase_if(expected, [&](const auto& one) { return one.first == overlay.rollouts().requests().size() - 1; });
    EXPECT_EQ(back, expected);
}

TEST_F(RolloutBreaksTest, BranchThatLeavesTheRealTrajectoryStopsOnceThatIsHeld) {
    overlay.setBound({{0.3, 3}, false});
    settleAll();
    ASSERT_FALSE(overlay.rollouts().shownRow()->divergence) << "the rollout itself stays";
    moveAside(0.94);
    ASSERT_EQ(window.shown()->branch, 1u);
    stopOn("divergence");
    press();
    EXPECT_TRUE(window.shown()->atBreak) << said();
    // Beyond at the first instant after, 1 s, and held for 0.3 s.
    EXPECT_EQ(window.shown()->tick(), ticksOf(1.3));
    window.session().seek(ticksOf(1.8));
    settleAll();
    press(Qt::ShiftModifier);
    EXPECT_EQ(window.shown()->tick(), ticksOf(1.3));
}

TEST_F(RolloutBreaksTest, EscapeEndsTheSearch) {
    stopOn("robot[1].x > 1000");
    overlay.shown().goToBreak({});
    window.session().settle();
    QApplication::processEvents();
    overlay.cancel();
    settleAll();
    EXPECT_EQ(shownRollout(), 0u);
    EXPECT_THAT(said(), testing::Not(HasSubstr("nor in those")));
    EXPECT_FALSE(window.messages().has("work"));
}

TEST_F(RolloutBreaksTest, BranchThatIsNotSavedIsNotLeft) {
    moveAside(0.5);
    ASSERT_TRUE(window.files().saver().hasUnsaved());
    stopOn("robot[1].x > 1000");
    press();
    EXPECT_THAT(said(), HasSubstr("not saved"));
    EXPECT_EQ(window.shown()->branch, 1u);
}

}  // namespace
}  // namespace mrose::gui
