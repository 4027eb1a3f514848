#include "identification/held_out_groups.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "identification/motion_samples.h"
#include "identification/recipes.h"
#include "logs/pose_grid.h"
#include "support/units.h"

namespace mrose {
namespace {

/// Windows of 2 s with the commands of 3 s before, on one clock; the robot drives with v = 0.1 (group + 1) m/s.
Log shortWindows(int groups) {
    Log log;
    log.source = "windows";
    RobotLog robot{"1", {}, {}};
    for (int group = 0; group < groups; ++group) {
        Trajectory trajectory;
        trajectory.group = group;
        const double v = 0.1 * (group + 1);
        for (Nanoseconds t = 0; t < 5000 * ms; t += 50 * ms) {
            trajectory.commands.push_back({t, {v, 0}});
            trajectory.measuredVelocity.push_back({t, {2 * v, 0.5}});
            if (t >= 3000 * ms) trajectory.poses.push_back({t, {v * toSeconds(t), 0, 0}});
        }
        robot.trajectories.push_back(std::move(trajectory));
    }
    log.robots.push_back(std::move(robot));
    return log;
}

std::set<int> groupsOf(const Log& log) {
    std::set<int> groups;
    for (const Trajectory& trajectory : log.robots[0].trajectories) groups.insert(trajectory.group);
    return groups;
}

TEST(HoldOut, HoldsEveryNthGroupAndNegativeOnesToo) {
    const HoldOut fifth{5, 3};
    for (const int group : {-2, 3, 8, 1003}) EXPECT_TRUE(fifth.holds(group)) << group;
    for (const int group : {-3, 0, 4, 5}) EXPECT_FALSE(fifth.holds(group)) << group;
    EXPECT_FALSE(HoldOut{}.holds(0));
}

TEST(HoldOut, OthersAreNumberedWithoutGaps) {
    for (const int offset : {0, 1, 4}) {
        const HoldOut fifth{5, offset};
        std::set<int> ranks;
        for (int group = 0; group < 100; ++group)
            if (!fifth.holds(group)) ranks.insert(fifth.rankOfOther(group));
        EXPECT_EQ(ranks.size(), 80u) << offset;
        EXPECT_EQ(*ranks.rbegin() - *ranks.begin(), 79) << offset;
    }
    EXPECT_EQ(HoldOut{}.rankOfOther(17), 17);
}

TEST(HeldOutGroups, PartsShareNothingAndLackNothing) {
    const Log log = shortWindows(11);
    const HoldOut third{3, 1};
    const auto learned = partOf(log, third, LogPart::learned), heldOut = partOf(log, third, LogPart::heldOut);
    ASSERT_TRUE(learned && heldOut);
    EXPECT_EQ(groupsOf(*heldOut), (std::set{1, 4, 7, 10}));
    EXPECT_EQ(groupsOf(*learned), (std::set{0, 2, 3, 5, 6, 8, 9}));
}

TEST(HeldOutGroups, NothingLeftIsAnError) {
    const auto nothing = partOf(shortWindows(3), {5, 4}, LogPart::heldOut);
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().message(), "windows: has no group of trajectories to hold out");
    const auto all = partOf(shortWindows(1), {5, 0}, LogPart::learned);
    ASSERT_FALSE(all);
    EXPECT_EQ(all.error().message(), "windows: has no group of trajectories to learn from besides those held out");
}

TEST(MotionSamplesOfShortWindows, ReachFromTheFirstPoseToTheLast) {
    const std::vector<Log> logs{shortWindows(4)};
    const MotionNetwork network = velocityBlueprint({}, {"1"}, {});
    const auto samples = motionSamples(logs, network, {.phases = 2, .folds = 2});
    ASSERT_TRUE(samples);
    ASSERT_EQ(samples->runs.size(), 8u);
    for (const SampleRun& run : samples->runs) {
        EXPECT_EQ(run.count, run.phase == 0 ? 19u : 18u);
        EXPECT_EQ(samples->samples[run.first].start, (3000 + 50 * run.phase) * ms);
    }
}

TEST(MotionSamplesOfShortWindows, WithoutEarlierCommandsWaitForThem) {
    std::vector<Log> logs{shortWindows(1)};
    auto& commands = logs[0].robots[0].trajectories[0].commands;
    commands.erase(commands.begin(), commands.begin() + 50);  // the first one is now 0.5 s before the truth
    const auto samples = motionSamples(logs, velocityBlueprint({}, {"1"}, {}), {.phases = 1});
    ASSERT_TRUE(samples);
    EXPECT_EQ(samples->samples.front().start, 4000 * ms);
}

TEST(MotionSamplesOfShortWindows, VelocitiesAreTheRobotsOwn) {
    const std::vector<Log> logs{shortWindows(2)};
    const auto samples = motionSamples(logs, velocityBlueprint({}, {"1"}, {}), {});
    ASSERT_TRUE(samples);
    for (const SampleRun& run : samples->runs)
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            EXPECT_NEAR(samples->inputsOf(i)[0], 20 * samples->samples[i].increment.x, 1e-9);  // 2 v over a period
            EXPECT_NEAR(samples->inputsOf(i)[1], 0.5, 1e-12);
            EXPECT_NEAR(samples->samples[i].after.w, 0.5, 1e-12);
        }
}

TEST(MotionSamplesOfShortWindows, FoldsAreEvenWithoutTheHeldOutGroups) {
    const HoldOut fifth{5, 4};
    const auto learned = partOf(shortWindows(20), fifth, LogPart::learned);
    ASSERT_TRUE(learned);
    const std::vector<Log> logs{*learned};
    const auto samples =
        motionSamples(logs, velocityBlueprint({}, {"1"}, {}), {.phases = 1, .folds = 4, .heldOut = fifth});
    ASSERT_TRUE(samples);
    std::vector<int> runs(4);
    for (const SampleRun& run : samples->runs) ++runs.at(static_cast<std::size_t>(run.fold));
    EXPECT_EQ(runs, (std::vector{4, 4, 4, 4}));
}

/// Windows of 2 s without a pause between them; each begins with the commands of the 4 s before it, like the Husky's.
Log continuedWindows(int windows) {
    Log log;
    log.source = "windows";
    RobotLog robot{"1", {}, {}};
    for (int window = 0; window < windows; ++window) {
        Trajectory trajectory;
        trajectory.group = window / 2;
        const Nanoseconds begin = window * 2000 * ms;
        for (Nanoseconds t = std::max<Nanoseconds>(0, begin - 4000 * ms); t < begin + 2000 * ms; t += 50 * ms) {
            const double v = 0.1 * toSeconds(t) / 4;
            trajectory.commands.push_back({t, {v, 0}});
            trajectory.blips.push_back({t, {}});
            trajectory.measuredVelocity.push_back({t, {v, 0}});
            trajectory.measuredRotation.push_back({t, {}});
            if (t >= begin) trajectory.poses.push_back({t, {v * toSeconds(t), 0, 0}});
        }
        robot.trajectories.push_back(std::move(trajectory));
    }
    log.robots.push_back(std::move(robot));
    return log;
}

TEST(MotionSamplesOfContinuedWindows, WhatIsLearnedFromReadsNothingOfTheFoldThatIsHeldOut) {
    const Log log = continuedWindows(16);
    const MotionNetwork network = velocityBlueprint({}, {"1"}, {});
    const Nanoseconds memory = InputReader(network).memory();
    const auto samples = motionSamples(std::vector<Log>{log}, network, {.phases = 2, .folds = 4});
    ASSERT_TRUE(samples);
    int cut = 0, whole = 0;
    for (int heldOut = 0; heldOut < 4; ++heldOut)
        for (const SampleRun& run : samples->runs) {
            const std::size_t first = run.firstLearned(heldOut);
            if (run.fold == heldOut) {
                EXPECT_EQ(first, run.count);
                continue;
            }
            (first > 0 ? cut : whole) += 1;
            for (const Trajectory& other : log.robots[0].trajectories) {
                if (other.group % 4 != heldOut) continue;
                const Nanoseconds begin = other.poses.front().time, end = other.poses.back().time;
                for (std::size_t i = first; i < run.count; ++i) {
                    const Nanoseconds start = samples->samples[run.first + i].start;
                    EXPECT_TRUE(start - memory >= end || start < begin);
                }
                // No more is lost than that.
                if (first > 0 && first < run.count) {
                    const Nanoseconds lost = samples->samples[run.first + first - 1].start;
                    EXPECT_TRUE(lost - memory < end || lost > end + 2000 * ms);
                }
            }
        }
    EXPECT_EQ(cut, 14)
        << "the first window of each group but the first one, at both phases, where the group before is held out";
    EXPECT_EQ(whole, 4 * 32 - 32 - 14);
}

TEST(HeldOutGroups, WhatIsLearnedFromTellsNothingOfThem) {
    const Log log = continuedWindows(12);  // of the groups 0 to 5
    const auto learned = partOf(log, {3, 1}, LogPart::learned);
    ASSERT_TRUE(learned);
    ASSERT_EQ(learned->robots[0].trajectories.size(), 8u);
    for (const Trajectory& trajectory : learned->robots[0].trajectories) {
        const Nanoseconds begin = trajectory.poses.front().time;
        // Groups 2 and 5 follow a held-out one: 1 and 4 end at 8 s and 20 s.
        const Nanoseconds known = trajectory.group == 2   ? 8000 * ms
                                  : trajectory.group == 5 ? 20000 * ms
                                                          : std::max<Nanoseconds>(0, begin - 4000 * ms);
        EXPECT_EQ(trajectory.commands.front().time, known);
        EXPECT_EQ(trajectory.blips.front().time, known);
        EXPECT_EQ(trajectory.measuredVelocity.front().time, known);
        EXPECT_EQ(trajectory.measuredRotation.front().time, known);
    }
    const auto heldOut = partOf(log, {3, 1}, LogPart::heldOut);
    ASSERT_TRUE(heldOut);
    EXPECT_EQ(heldOut->robots[0].trajectories[0].commands.front().time, 0) << "commands are known when they are given";
}

TEST(VelocityBlueprint, IsLearnedOnRolloutsFromTheMeasuredVelocity) {
    const MotionNetwork network = velocityBlueprint({}, {"1"}, {.deadTimeV = 0.3, .deadTimeW = 0.25});
    EXPECT_EQ(network.form, MotionNetwork::Form::state);
    EXPECT_EQ(network.inputs[0].quantity, NetworkInput::Quantity::velocityV);
    EXPECT_EQ(network.inputs[1].quantity, NetworkInput::Quantity::velocityW);
    EXPECT_DOUBLE_EQ(network.inputs[2].newest, 0);
    EXPECT_DOUBLE_EQ(network.inputs[2].oldest, 0.25);  // one bin until the earlier dead time ends
}

}  // namespace
}  // namespace mrose
