// Breakpoints that count go on from rollout to rollout of a log.
#include <algorithm>

#include <gmock/gmock.h>

#include "gui/rollout_fixture.h"

namespace mrose::gui {
namespace {

using testing::HasSubstr;

/// A condition that is met in some ticks of each rollout, whatever the robot does.
class RolloutHitsTest : public RolloutTest {
protected:
    static constexpr std::int64_t period = 40, phase = 7;

    void SetUp() override {
        RolloutTest::SetUp();
        window.session().setSpeed(0);
    }
    void countFrom(int from, bool once = false) {
        Breakpoint breakpoint;
        breakpoint.text = "tick % " + std::to_string(period) + " == " + std::to_string(phase);
        breakpoint.from = from;
        breakpoint.oneShot = once;
        window.session().setBreakpoints({breakpoint});
        settleAll();
    }
    std::int64_t length(std::size_t rollout) const {
        return ticksOf(0.1 * overlay.rollouts().requests()[rollout].steps);
    }
    /// In which rollout, and at which of its ticks, it is met the n-th time, from 1; nullopt: not so often.
    std::optional<std::pair<std::size_t, std::int64_t>> meeting(int n) const {
        for (std::size_t rollout = 0; rollout < overlay.rollouts().requests().size(); ++rollout)
            for (std::int64_t tick = phase; tick <= length(rollout); tick += period)
                if (--n == 0) return std::pair(rollout, tick);
        return {};
    }
    int meetings() const {
        int n = 0;
        while (meeting(n + 1)) ++n;
        return n;
    }
    std::optional<std::pair<std::size_t, std::int64_t>> place() const {
        return std::pair(shownRollout(), window.shown()->tick());
    }
    /// To where it stops, be it rollouts further on.
    void play() {
        QTest::keyClick(&window, Qt::Key_Space);
        ASSERT_TRUE(QTest::qWaitFor(
            [&] {
                window.session().settle();
                return !window.shown()->playing && !overlay.opening();
            },
            60'000));
        settleAll();
    }
    const BreakpointState& counted() const { return window.shown()->breakpoints.at(0); }
    void expectMet(int n) {
        EXPECT_EQ(place(), meeting(n));
        EXPECT_TRUE(window.shown()->atBreak) << said();
        EXPECT_EQ(counted().hits, n);
    }
};

TEST_F(RolloutHitsTest, PlayingStopsFromTheNthTimeOfAllRolloutsOn) {
    const int n = 5;
    ASSERT_GT(meeting(n)->first, 0u);
    countFrom(n);
    play();
    expectMet(n);
    play();
    expectMet(n + 1);
    play();
    expectMet(n + 2);
    EXPECT_GT(shownRollout(), meeting(n + 1)->first);
    // Back in an earlier rollout so many times lie behind as there.
    open(0);
    EXPECT_EQ(counted().hits, 0);
    play();
    expectMet(n);
}

TEST_F(RolloutHitsTest, SearchingCountsEachRolloutOnce) {
    const int all = meetings();
    countFrom(all + 1);
    for (int i = 0; i < 2; ++i) {
        press();
        EXPECT_EQ(place(), std::pair(std::size_t{0}, std::int64_t{0}));
        EXPECT_THAT(said(), HasSubstr("nor in those after it"));
        EXPECT_EQ(counted().all, all);
    }
    // Now it is known of all rollouts; one that is opened is simulated anew.
    open(2);
    int before = 0, upTo = 0;
    while (meeting(before + 1)->first < 2) ++before;
    while (meeting(upTo + 1)->first < 3) ++upTo;
    EXPECT_EQ(counted().hits, before);
    EXPECT_EQ(counted().all, all - (upTo - before));
    window.session().seek(phase);
    settleAll();
    EXPECT_EQ(counted().hits, before + 1);
    for (const int n : {all - 1, all}) {
        countFrom(n);
        press();
        expectMet(n);
    }
}

TEST_F(RolloutHitsTest, OnceIsOnceInAllRollouts) {
    const int n = 4;
    countFrom(n, true);
    press();
    expectMet(n);
    EXPECT_FALSE(counted().breakpoint.enabled);
    const auto stood = place();
    press();
    EXPECT_EQ(place(), stood);
    EXPECT_THAT(said(), HasSubstr("nor in those after it"));
}

/// By another bound the robots leave the log elsewhere, or not at all: what was counted is of no use.
TEST_F(RolloutHitsTest, DivergencesOfAnotherBoundAreForgotten) {
    overlay.setBound({{0.01, 0.5}, false});
    Breakpoint breakpoint;
    breakpoint.text = "divergence";
    breakpoint.from = 1000;
    window.session().setBreakpoints({breakpoint});
    settleAll();
    const auto leaving = std::count_if(overlay.rollouts().rows().begin(), overlay.rollouts().rows().end(),
                                       [](const RolloutRow& row) { return row.divergence.has_value(); });
    ASSERT_GT(leaving, 2);
    press();
    EXPECT_EQ(counted().all, leaving);
    overlay.setBound({{100, 3.1}, false});
    settleAll();
    EXPECT_EQ(counted().all, 0);
}

constexpr const char* overText = "The last rollout of the log is over";

TEST_F(RolloutHitsTest, PlayingEndsOnceWhereTheLogDoes) {
    window.session().setBreakpoints({});
    const std::size_t last = overlay.rollouts().requests().size() - 1;
    open(last - 1);
    play();
    EXPECT_EQ(place(), std::pair(last, length(last)));
    EXPECT_THAT(said(), HasSubstr(overText));
    // Who wants to may go on, as in any run.
    window.session().setSpeed(1);
    QTest::keyClick(&window, Qt::Key_Space);
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.shown()->tick() > length(last); }, 60'000));
    EXPECT_TRUE(window.shown()->playing);
    EXPECT_EQ(shownRollout(), last);
}

/// However one came there.
TEST_F(RolloutHitsTest, PlayingFromARolloutsEndIsTheNextRollout) {
    window.session().setBreakpoints({});
    const std::size_t last = overlay.rollouts().requests().size() - 1;
    open(last - 1);
    window.session().seek(length(last - 1));
    settleAll();
    QTest::keyClick(&window, Qt::Key_Space);
    ASSERT_TRUE(QTest::qWaitFor([&] { return shownRollout() == last && !overlay.opening(); }, 60'000));
    ASSERT_TRUE(QTest::qWaitFor([&] { return !window.shown()->playing && window.shown()->tick() > 0; }, 60'000));
    open(last);
    window.session().seek(length(last));
    settleAll();
    QTest::keyClick(&window, Qt::Key_Space);
    settleAll();
    EXPECT_FALSE(window.shown()->playing);
    EXPECT_EQ(window.shown()->tick(), length(last));
    EXPECT_THAT(said(), HasSubstr(overText));
    QTest::keyClick(&window, Qt::Key_Space);
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.shown()->tick() > length(last); }, 60'000));
}

}  // namespace
}  // namespace mrose::gui
