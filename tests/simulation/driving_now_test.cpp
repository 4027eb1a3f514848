#include "simulation/driving_now.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "condition/condition.h"
#include "experiment/results_row.h"
#include "motion/learned_model.h"
#include "motion/network_fixture.h"
#include "scenario/delayed_network.h"
#include "simulation/run_statistics.h"
#include "simulation/small_world.h"

namespace mrose {
namespace {

/// Of a network that knows rest and driving straight at 0.3 m/s, and what lies around them.
MotionNetwork knowsStraight() {
    MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::history);
    FamiliarDriving& familiar = network.familiar.emplace();
    familiar.v = {0, 0.2, 0.1};
    familiar.w = {0, 0.2, 0.1};
    familiar.periods = 1000;
    familiar.prototypes = {{}, {3, 0, 3, 0, 0, 0}};
    familiar.distances = {1, 1.5, 2.5};
    return network;
}

std::shared_ptr<const MotionModel> learned(const MotionNetwork& network) {
    return std::make_shared<const LearnedModel>(std::make_shared<const LearnedMotion>(network), "a");
}

/// Its third robot is told to turn from 1 s to 2 s, which is read for 0.2 s more.
Scenario straightAndTurning() {
    const std::vector<StampedCommand> turns{{0, {0.3, 0}}, {1'000'000'000, {0.3, 1}}, {2'000'000'000, {0.3, 0}}};
    return SmallWorld()
        .robot(discRobot(), {}, std::make_shared<const Told>(Command{0.3, 0}), learned(knowsStraight()))
        .robot(discRobot(), {0, 50, 0}, std::make_shared<const Told>(Command{0.3, 1}), ideal())
        .robot(discRobot(), {0, -50, 0}, std::make_shared<const Told>(turns), learned(knowsStraight()))
        .scenario();
}

TEST(DrivingNow, RunsSayForHowLongEachRobotsDrivingWasUnfamiliar) {
    const Scenario scenario = straightAndTurning();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    RunStatistics statistics(scenario, state);
    Condition condition = *compileCondition("robot[3].unfamiliar > 0.9", scenario, "test");
    Condition unknown = *compileCondition("robot[2].unfamiliar ~= robot[2].unfamiliar", scenario, "test");
    double held = 0;
    for (int i = 0; i < 200; ++i) {
        step(scenario, state, buffers, {}, &trace);
        statistics.add(state, trace);
        held += *condition.holds({&scenario, &state, &trace}) ? 0.02 : 0;
        EXPECT_TRUE(*unknown.holds({&scenario, &state, &trace})) << "NaN";
    }
    EXPECT_NEAR(held, 1.2, 0.1) << "a little later it is read, and as much longer";
    ASSERT_EQ(statistics.unfamiliar.size(), 3u);
    EXPECT_EQ(statistics.unfamiliar[0], 0);
    EXPECT_EQ(statistics.unfamiliar[1], std::nullopt);
    EXPECT_NEAR(0.02 * double(*statistics.unfamiliar[2]), held, 0.101) << "by whole control periods";
    EXPECT_EQ(statistics.anyUnfamiliar, *statistics.unfamiliar[2]);
    EXPECT_EQ(statistics.shareOf(50), 0.25);
}

TEST(DrivingNow, OtherModelsAndOlderFilesDoNotKnow) {
    const Scenario scenario = straightAndTurning();
    EXPECT_NE(familiarDriving(scenario.scene(), 0), nullptr);
    EXPECT_EQ(familiarDriving(scenario.scene(), 1), nullptr);
    MotionNetwork older = knowsStraight();
    older.familiar.reset();
    const Scenario withoutSection =
        SmallWorld().robot(discRobot(), {}, std::make_shared<const Told>(Command{}), learned(older)).scenario();
    EXPECT_EQ(familiarDriving(withoutSection.scene(), 0), nullptr);
    EXPECT_EQ(resultsHeader(withoutSection.parts()).find("unfamiliar"), std::string::npos);
}

/// What is read of the commands so much later is described so much later.
TEST(DrivingNow, AnotherDeadTimeLeavesFamiliarWhatWasFamiliar) {
    const MotionNetwork late = delayed(knowsStraight(), 300'000'000, 300'000'000);
    const DrivingReader now(knowsStraight().form, *knowsStraight().familiar), later(late.form, *late.familiar);
    CommandHistory history;
    history.issue(0, {0.3, 0});
    history.issue(900'000'000, {0.3, 1});
    const auto at = [&](std::int64_t time) { return MotionInput{&history, time, {}, {}, {}}; };
    EXPECT_TRUE(now.isUnfamiliar(at(1'100'000'000)));
    EXPECT_FALSE(later.isUnfamiliar(at(1'100'000'000)));
    EXPECT_EQ(later.driving(at(1'400'000'000)), now.driving(at(1'100'000'000)));
}

TEST(DrivingNow, RowsOfABatchHaveTheSharesWhereANetworkKnowsThem) {
    const Scenario scenario = straightAndTurning();
    RunOptions options;
    options.duration = 4'000'000'000;
    const auto result = run(scenario, scenario.initialState(), options);
    ASSERT_TRUE(result);
    const auto header = resultsCells(resultsHeader(scenario.parts()));
    const std::string row = resultsRow({1, 1}, *result, scenario.parts(), "command");
    const auto cells = resultsCells(row);
    ASSERT_EQ(header.size(), cells.size());
    const auto cellOf = [&](const std::string& column) {
        const auto found = std::find(header.begin(), header.end(), column);
        return found == header.end() ? NAN : std::stod(cells[std::size_t(found - header.begin())]);
    };
    const double share = double(*result->statistics.unfamiliar[2]) / 200;
    EXPECT_GT(share, 0.25);
    EXPECT_EQ(cellOf("unfamiliar"), share);
    EXPECT_EQ(cellOf("unfamiliar 1"), 0);
    EXPECT_TRUE(std::isnan(cellOf("unfamiliar 2")));
    EXPECT_EQ(cellOf("unfamiliar 3"), share);
    ResultsSummary summary(scenario.scene());
    summary.add(row);
    EXPECT_EQ(summary.columns.back().name, unfamiliarColumn);
    EXPECT_EQ(summary.columns.back().mean, share);
}

}  // namespace
}  // namespace mrose
