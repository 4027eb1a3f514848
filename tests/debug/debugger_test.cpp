// The debugger without a window: what is asked for, against stepping the world.
#include "debug/debugger.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/step.h"
#include "support/scenes.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using testing::HasSubstr;

class DebuggerTest : public testing::Test {
protected:
    DebuggerTest() {
        ScenarioParts parts = fieldScenario({.robots = 3}).parts();
        parts.duration = 4 * nanosecondsPerSecond;
        scenario = std::make_shared<const Scenario>(std::move(parts));
        OpenedRun run;
        run.start = scenario->initialState(7);
        run.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, scenario});
        debugger.open(run);
        start = run.start;
    }
    /// By stepping alone.
    WorldState stepped(std::int64_t ticks) const {
        WorldState state = start;
        StepBuffers buffers;
        for (std::int64_t i = 0; i < ticks; ++i) step(*scenario, state, buffers);
        return state;
    }
    std::int64_t tick() const { return debugger.run().tick(); }
    bool isAt(const WorldState& state) const { return hashOf(debugger.run().state()) == hashOf(state); }
    void stopOn(const std::string& text) { debugger.breakpoints().add({.text = text}); }

    std::shared_ptr<const Scenario> scenario;
    WorldState start;
    Debugger debugger;
};

TEST_F(DebuggerTest, GoesToAnyTickAsSteppingDoes) {
    for (const std::int64_t wanted : {70, 20, 71, 0, 133}) {
        debugger.goTo(wanted, false);
        EXPECT_EQ(tick(), wanted);
        EXPECT_TRUE(isAt(stepped(wanted))) << wanted;
    }
    debugger.stepBy(-13);
    EXPECT_TRUE(isAt(stepped(120)));
    debugger.stepBy(25);
    EXPECT_TRUE(isAt(stepped(145)));
}

TEST_F(DebuggerTest, PlaysToItsEndAndSaysSoOnce) {
    debugger.play();
    std::int64_t ticks = 0;
    while (debugger.playing()) {
        debugger.playOn();
        ++ticks;
    }
    EXPECT_EQ(ticks, 200);
    EXPECT_EQ(debugger.message(), "4 s are over; it can go on");
    EXPECT_EQ(debugger.takeShown().event, RunEvent::playedOut);
    EXPECT_EQ(debugger.takeShown().event, RunEvent::none);
    debugger.stopAt(230);
    debugger.play();
    while (debugger.playing()) debugger.playOn();
    EXPECT_TRUE(isAt(stepped(230)));
}

TEST_F(DebuggerTest, BreakpointsStopPlayingAndOnlyThoseWaysThatMayBreak) {
    stopOn("tick == 60");
    debugger.play();
    while (debugger.playing()) debugger.playOn();
    EXPECT_EQ(tick(), 60);
    EXPECT_TRUE(debugger.atBreak());
    debugger.goTo(0, false);
    debugger.goTo(100, false);
    EXPECT_EQ(tick(), 100);
    EXPECT_FALSE(debugger.atBreak());
    debugger.open({.setup = debugger.run().branches().record(0).setupPointer(), .start = start});
    stopOn("tick == 60");
    debugger.goTo(100, true);
    EXPECT_EQ(tick(), 60);
    EXPECT_TRUE(debugger.atBreak());
}

TEST_F(DebuggerTest, GoesToTheNextBreakAndToTheLast) {
    stopOn("tick % 50 == 0");
    for (const std::int64_t expected : {50, 100, 150}) {
        debugger.goToBreak({});
        EXPECT_EQ(tick(), expected);
        EXPECT_EQ(debugger.takeShown().event, RunEvent::broke);
    }
    debugger.goToBreak({.back = true});
    EXPECT_EQ(tick(), 100);
    debugger.goToBreak({.back = true, .text = "tick == 17"});
    EXPECT_EQ(tick(), 17);
    debugger.goToBreak({.back = true, .text = "tick == 18"});
    EXPECT_EQ(tick(), 17);
    EXPECT_EQ(debugger.takeShown().event, RunEvent::noBreak);
    EXPECT_THAT(debugger.message(), HasSubstr("never held: tick == 18"));
}

TEST_F(DebuggerTest, SearchWithinARunStaysWhereNothingIsFound) {
    stopOn("tick == 250");
    debugger.goTo(30, false);
    debugger.goToBreak({}, BreakReach::within);
    EXPECT_EQ(tick(), 30);
    EXPECT_EQ(debugger.message(), "No break in the rest of this run");
    debugger.goToBreak({}, BreakReach::on);
    EXPECT_EQ(tick(), 250) << "beyond where playing ends";
    debugger.goToBreak({}, BreakReach::on);
    EXPECT_EQ(debugger.message(), "No break up to 8 s; it can go on");
    EXPECT_TRUE(isAt(stepped(400)));
}

TEST_F(DebuggerTest, LongWaysEndWhereTheyAreNotToGoOn) {
    int shown = 0, asked = 0;
    const Watch watch{[&](double) { return ++asked < 4; }, [&] { ++shown; }};
    debugger.goTo(10'000, false, watch);
    EXPECT_EQ(tick(), 64) << "it is asked every 16 ticks";
    EXPECT_EQ(shown, 3);
    EXPECT_TRUE(isAt(stepped(64)));
    stopOn("tick < 0");
    asked = 0;
    debugger.goToBreak({}, BreakReach::on, watch);
    EXPECT_LT(tick(), 200);
    EXPECT_THAT(debugger.message(), HasSubstr("Ended before"));
    EXPECT_EQ(debugger.takeShown().event, RunEvent::none);
}

TEST_F(DebuggerTest, EditsBeginBranchesWhichAreTakenBack) {
    debugger.goTo(50, false);
    const Pose aside{1, 1, 0.5};
    ASSERT_TRUE(debugger.branchOff(moveBody(frameOf(debugger.run()), 1, aside)));
    EXPECT_EQ(debugger.run().state().robots[1].pose.x, 1);
    debugger.goTo(90, false);
    Shown shown = debugger.takeShown();
    ASSERT_EQ(shown.branches.size(), 2u);
    EXPECT_EQ(shown.branches[1].departed, 50);
    EXPECT_THAT(shown.branches[1].name, HasSubstr("moved"));
    EXPECT_EQ(shown.besideBranch, 0u);
    EXPECT_EQ(hashOf(shown.beside->state), hashOf(stepped(90))) << "what would have happened goes on beside";
    EXPECT_FALSE(isAt(stepped(90)));
    debugger.undo();
    EXPECT_TRUE(isAt(stepped(tick())));
    debugger.redo();
    EXPECT_EQ(debugger.run().branch(), 1u);
    debugger.show(7, 0);
    EXPECT_EQ(debugger.run().branch(), 1u) << "there is none of that number";
}

TEST_F(DebuggerTest, SeedsAndNoiseAreEditsToo) {
    debugger.goTo(40, false);
    ASSERT_TRUE(debugger.branchOff(restartWithSeed(debugger.run().branches().record(0).setupPointer(), 8)));
    EXPECT_TRUE(isAt(scenario->initialState(8)));
    debugger.show(0, 40);
    ASSERT_TRUE(debugger.branchOff(changeNoise()));
    WorldState expected = stepped(40);
    ++expected.seed;
    EXPECT_TRUE(isAt(expected));
}

}  // namespace
}  // namespace mrose
