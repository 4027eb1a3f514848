// Numbers of plotted values at every tick, against stepping the world.
#include "debug/value_series.h"

#include <cmath>

#include <gtest/gtest.h>

#include "debug/debugger.h"
#include "debug/series_walk.h"
#include "simulation/step.h"
#include "support/scenes.h"

namespace mrose {
namespace {

class ValueSeriesTest : public testing::Test {
protected:
    ValueSeriesTest() {
        scenario = std::make_shared<const Scenario>(fieldScenario({.robots = 3}));
        OpenedRun run;
        run.setup = std::make_shared<const BranchSetup>(BranchSetup{{}, scenario});
        run.start = scenario->initialState(7);
        debugger.open(run);
        debugger.goTo(200, false);
        x = {"x", scenario->scene().robots[1].name, ""};
        speed = {"speed", scenario->scene().robots[2].name, ""};
    }
    std::shared_ptr<const Scenario> scenario;
    Debugger debugger;
    ValueKey x, speed;
    ValueSeries series;
};

TEST_F(ValueSeriesTest, AreThoseOfSteppingInEveryBranch) {
    const FieldFrame frame = frameOf(debugger.run());
    Edit edit = moveBody(frame, 1, {frame.poseOf(1).x, frame.poseOf(1).y + 0.05, 0});
    ASSERT_TRUE(debugger.branchOff(edit));
    debugger.goTo(250, false);
    series.want({x, speed});
    series.follow(1, nullptr, {{1, 200, 250}, {0, 0, 200}});
    EXPECT_EQ(series.behind(), 51 + 201);
    computeAll(series, debugger.run().branches());
    EXPECT_EQ(series.behind(), 0);
    WorldState state = scenario->initialState(7);
    StepBuffers buffers;
    const auto expectAt = [&](std::uint32_t branch) {
        const TickNumbers *const xs = series.find(branch, x), *const speeds = series.find(branch, speed);
        ASSERT_TRUE(xs != nullptr && speeds != nullptr);
        EXPECT_EQ(xs->at(state.tick), static_cast<float>(state.robots[1].pose.x)) << state.tick;
        EXPECT_TRUE(std::isfinite(speeds->at(state.tick))) << state.tick;
    };
    while (state.tick < 200) {
        expectAt(0);
        step(*scenario, state, buffers);
    }
    edit.change(*scenario, state);
    for (; state.tick <= 250; step(*scenario, state, buffers)) expectAt(1);
    EXPECT_TRUE(std::isnan(series.find(1, x)->at(251)));
}

TEST_F(ValueSeriesTest, OnlyWhatIsMissingIsComputedAndCancelledTicksStayUnknown) {
    series.want({x});
    series.follow(1, nullptr, {{0, 0, 100}});
    computeAll(series, debugger.run().branches());
    series.want({x, speed});
    const auto task = series.nextTask();
    ASSERT_TRUE(task);
    EXPECT_EQ(task->values, std::vector<ValueKey>{speed});
    series.cancel();
    EXPECT_EQ(series.behind(), 0);
    series.follow(1, nullptr, {{0, 0, 120}});
    computeAll(series, debugger.run().branches());
    EXPECT_TRUE(std::isnan(series.find(0, speed)->at(100)));
    EXPECT_TRUE(std::isfinite(series.find(0, speed)->at(101)));
    EXPECT_TRUE(std::isfinite(series.find(0, x)->at(100)));
    series.want({speed});
    EXPECT_EQ(series.find(0, x), nullptr) << "numbers of others are forgotten";
    series.follow(2, nullptr, {{0, 0, 120}});
    EXPECT_EQ(series.behind(), 121) << "those of another run, too";
}

TEST_F(ValueSeriesTest, BranchesThatAreNotThereGiveNothing) {
    series.want({x});
    series.follow(1, nullptr, {{7, 0, 10}});
    computeAll(series, debugger.run().branches());
    EXPECT_EQ(series.behind(), 0);
    EXPECT_TRUE(std::isnan(series.find(7, x)->at(5)));
}

TEST(ValueSeries, NewestTicksGoBeforeThePastOfAnotherValue) {
    const BranchTicks wanted{0, 100, 999};
    const auto next = [&](const std::vector<std::int64_t>& ends) { return nextTicks(wanted, ends); };
    EXPECT_FALSE(next({}));
    EXPECT_FALSE(next({1000, 1000}));
    // One is new and has all of its past before it: those that have come far go on first.
    const auto front = next({990, 100, 990});
    EXPECT_TRUE(front->front);
    EXPECT_EQ(front->tick, 990);
    EXPECT_EQ(front->values, (std::vector<std::size_t>{0, 2}));
    const auto past = next({1000, 100, 1000});
    EXPECT_FALSE(past->front);
    EXPECT_EQ(past->tick, 100);
    EXPECT_EQ(past->values, (std::vector<std::size_t>{1}));
    const auto begin = next({0, 100});
    EXPECT_FALSE(begin->front);
    EXPECT_EQ(begin->tick, 100);
    EXPECT_EQ(begin->values.size(), 2u);
}

}  // namespace
}  // namespace mrose
