// A real log opened, gone through and branched with core alone: by a program, and against what a comparison says.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debug/debugger.h"
#include "debug/log_rollouts.h"
#include "diagnosis/divergence_text.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/test_data.h"
#include "workflow/open_log.h"
#include "workflow/open_model.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using testing::HasSubstr;

std::string shippedLog() { return (sourceFolder() / "resources" / "logs" / "pioneer" / "random.csv").string(); }

/// A log with all of its rollouts compared, by a bound that robots leave.
struct ComparedLog {
    OpenedLog log;
    LogRollouts rollouts;
    Comparison comparison;

    static ComparedLog open(const std::string& place) {
        auto opened = openLogAsRun({place});
        EXPECT_TRUE(opened) << opened.error().message();
        ComparedLog result{std::move(*opened), {}, {}};
        result.rollouts.replace(result.log.world, result.log.plan, result.log.requests);
        result.rollouts.setBound({{0.02, 0.05}, false});
        auto compared = compareRollouts(*result.log.world, result.log.requests, result.rollouts.divergenceOptions(),
                                        [&](const std::vector<RolloutRow>& rows, double) {
                                            result.rollouts.addRows(rows);
                                            return true;
                                        });
        EXPECT_TRUE(compared) << compared.error().message();
        result.comparison = std::move(*compared);
        return result;
    }
};

TEST(LogDebugging, RowsSayWhatTheComparisonSays) {
    const ComparedLog compared = ComparedLog::open(shippedLog());
    DivergenceOptions options = compared.rollouts.divergenceOptions();
    options.diagnosed = 0;
    const auto divergences = divergencesOf(compared.rollouts.world(), compared.comparison, options);
    ASSERT_TRUE(divergences) << divergences.error().message();
    std::size_t left = 0;
    for (const RolloutRow& row : compared.rollouts.rows()) {
        const auto alike = [&](const ComparedRollout& rollout) {
            return rollout.request == row.rollout && rollout.robot == row.robot;
        };
        const auto& all = compared.comparison.rollouts;
        const auto at = std::find_if(all.begin(), all.end(), alike) - all.begin();
        const RolloutDivergence* const known = divergences->of(static_cast<std::size_t>(at));
        ASSERT_EQ(row.divergence.has_value(), known != nullptr) << row.rollout;
        if (known == nullptr) continue;
        EXPECT_EQ(row.divergence->time, known->divergence.time) << row.rollout;
        ++left;
    }
    EXPECT_GE(left, 3u);
}

/// From the shown rollout on and once around, each that is left is found; a search for the break agrees.
TEST(LogDebugging, NextLeftGoesThroughAllThatAreLeft) {
    ComparedLog compared = ComparedLog::open(shippedLog());
    LogRollouts& rollouts = compared.rollouts;
    std::vector<std::size_t> expected, found;
    for (const RolloutRow& row : rollouts.rows())
        if (row.divergence && (expected.empty() || expected.back() != row.rollout)) expected.push_back(row.rollout);
    rollouts.setShown(rollouts.requests().size() - 1);
    while (found.size() < expected.size()) {
        const auto next = rollouts.nextLeft();
        ASSERT_TRUE(next);
        found.push_back(*next);
        rollouts.setShown(next);
        EXPECT_EQ(rollouts.leavingRow()->rollout, *next);
    }
    if (expected.back() == rollouts.requests().size() - 1) std::rotate(found.begin(), found.end() - 1, found.end());
    EXPECT_EQ(std::set(found.begin(), found.end()), std::set(expected.begin(), expected.end()));
    rollouts.setShown(0);
    Breakpoint divergence;
    divergence.text = "divergence";
    const auto search = rollouts.searchOthers({}, {divergence}, {});
    const auto there = rolloutWithBreak(*rollouts.log(), search, [](double) { return true; });
    ASSERT_TRUE(there) << there.error().message();
    const auto first = std::find_if(expected.begin(), expected.end(), [](std::size_t rollout) { return rollout > 0; });
    EXPECT_EQ(there->rollout, first == expected.end() ? std::nullopt : std::optional(*first));
}

TEST(LogDebugging, DebuggerStopsWhereTheComparisonSaysAndGoesBack) {
    const ComparedLog compared = ComparedLog::open(shippedLog());
    const RolloutRow* const row = compared.rollouts.worstLeft();
    ASSERT_NE(row, nullptr);
    const auto run = openRollout(*compared.log.world, compared.log.requests[row->rollout], false);
    ASSERT_TRUE(run) << run.error().message();
    Debugger debugger(*run);
    const LeavingRobots leaving = leavingRobots(compared.rollouts.world(), {row, 1});
    debugger.breakpoints().setDivergence({leavesReality(leaving), whoLeaves(leaving)});
    debugger.breakpoints().add({.text = "divergence"});
    debugger.goToBreak({});
    EXPECT_TRUE(debugger.atBreak());
    EXPECT_EQ(debugger.run().tick(), debugger.run().setup().scene().ticksOf(row->divergence->time));
    EXPECT_THAT(debugger.message(), HasSubstr("leaves the logged trajectory"));
    // The simulated robot is where the comparison has it.
    const Pose& pose = debugger.run().state().robots[0].pose;
    const ComparedRollout* rollout = nullptr;
    for (const ComparedRollout& each : compared.comparison.rollouts)
        if (each.request == row->rollout && each.robot == row->robot) rollout = &each;
    const auto steps = static_cast<std::size_t>(row->divergence->time / WindowOptions{}.step);
    EXPECT_EQ(pose.x, rollout->simulated[steps - 1].x);
    EXPECT_EQ(pose.y, rollout->simulated[steps - 1].y);
    // Another command before it makes another way, and there is a way back.
    const StateHash there = hashOf(debugger.run().state());
    const std::int64_t tick = debugger.run().tick();
    debugger.stepBy(-30);
    ASSERT_TRUE(debugger.branchOff(changeDecision(frameOf(debugger.run()), 0, {.command = {0, 0}, .periods = 3})));
    debugger.goTo(tick, false);
    EXPECT_FALSE(hashOf(debugger.run().state()) == there);
    debugger.undo();
    debugger.goTo(tick, false);
    EXPECT_TRUE(hashOf(debugger.run().state()) == there);
}

TEST(LogDebugging, ProgramOfThirtyLinesFindsWhereAndWhy) {
    const auto run = [](const std::string& log) { return RunningProgram({MROSE_WHERE_IT_LEAVES, log}).finish(); };
    const ProgramResult missing = run("no_such_log.csv");
    EXPECT_EQ(missing.status, 1);
    EXPECT_THAT(missing.err, HasSubstr("no_such_log.csv: does not exist"));
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: MROSE_DATA names no folder";
    const std::string log = (*data / "mrclam" / "MRCLAM_Dataset6").string();
    const ProgramResult result = run(log);
    ASSERT_EQ(result.status, 0) << result.err;
    // As `mrose compare` has it, of the same rollout.
    const ComparedLog compared = [&] {
        ComparedLog all = ComparedLog::open(log);
        all.rollouts.setComparison(all.comparison);
        all.rollouts.setBound({DivergenceBound{}.constant, false});
        return all;
    }();
    const RolloutRow* const row = compared.rollouts.worstLeft();
    ASSERT_NE(row, nullptr);
    const std::string& name = compared.rollouts.world().robots()[row->robot].name;
    EXPECT_THAT(result.out, HasSubstr(name + " leaves the real trajectory"));
    const auto why = whyItLeaves(*compared.log.world,
                                 {compared.log.requests[row->rollout], *row, causeModels(*compared.log.world, {})}, {});
    ASSERT_TRUE(why) << why.error().message();
    EXPECT_THAT(result.out, HasSubstr('\n' + causeText(*why) + '\n'));
    EXPECT_THAT(result.out, HasSubstr(name + ": 0.00 m/s"));
}

TEST(RolloutPlan, ThatFitsNowhereSaysWhatWouldHelp) {
    const auto opened = openLogAsRun({shippedLog()});
    ASSERT_TRUE(opened);
    const auto wrong = [&](const RolloutPlan& plan) {
        const auto rollouts = plannedRollouts(*opened->world, plan);
        return rollouts ? "" : rollouts.error().message();
    };
    EXPECT_THAT(wrong({RolloutPlan::Cut::every, 0, 1e5}), testing::EndsWith("fits in; expected shorter rollouts"));
    EXPECT_THAT(wrong({RolloutPlan::Cut::every, 5, 1e5}), HasSubstr("expected an earlier start or shorter rollouts"));
    EXPECT_THAT(wrong({RolloutPlan::Cut::once, 1e5, 10}), HasSubstr("expected an earlier start"));
}

}  // namespace
}  // namespace mrose
