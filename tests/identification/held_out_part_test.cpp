#include "identification/held_out_part.h"

#include <algorithm>
#include <cmath>
#include <functional>
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
    const Nanoseconds memory = InputReader(network).lookBack();
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

/// Commands that change so often that a drive which ramps never catches up: what it follows depends on all of them.
Log restless(Log log, const std::function<bool(Nanoseconds)>& otherwise) {
    for (Trajectory& trajectory : log.robots[0].trajectories)
        for (StampedCommand& command : trajectory.commands) {
            const Nanoseconds phase = (command.time + (otherwise(command.time) ? 250 * ms : 0)) % (700 * ms);
            command.command.v = phase < 400 * ms ? 0.5 : -0.5;
        }
    return log;
}

TEST(MotionSamplesOfContinuedWindows, WhatADriveFollowsDoesNotCarryOverFromTheFoldThatIsHeldOut) {
    MotionNetwork network = velocityBlueprint({}, {"1"}, {});
    network.limits = {0.4, 0, 0, 0, 1};
    const InputReader reader(network);
    ASSERT_TRUE(reader.ramps());
    const SampleOptions options{.phases = 2, .folds = 4};
    const auto samplesOf = [&](const Log& log) { return motionSamples(std::vector<Log>{log}, network, options); };
    const Log windows = continuedWindows(16);
    const auto samples = samplesOf(restless(windows, [](Nanoseconds) { return false; }));
    ASSERT_TRUE(samples);
    std::size_t afterReaching = 0, reading = 0;
    for (int heldOut = 0; heldOut < 4; ++heldOut) {
        // But for the last command of a fold, which is in force when the next one begins.
        const auto garbled = samplesOf(restless(windows, [&](Nanoseconds time) {
            return static_cast<int>(time / (4000 * ms)) % 4 == heldOut && time % (4000 * ms) < 3950 * ms;
        }));
        ASSERT_TRUE(garbled);
        for (const SampleRun& run : samples->runs) {
            if (run.fold == heldOut) continue;
            const std::size_t first = run.firstLearned(heldOut);
            for (std::size_t i = 0; i < run.count; ++i) {
                const auto ours = samples->inputsOf(run.first + i), theirs = garbled->inputsOf(run.first + i);
                const bool equal = std::ranges::equal(ours, theirs);
                EXPECT_TRUE(equal || i < first) << "fold " << run.fold << ", pattern " << i << " of " << run.count;
                reading += equal ? 0 : 1;
            }
            afterReaching += first > 0 ? run.count - first : 0;
        }
    }
    EXPECT_GT(afterReaching, 20u);
    EXPECT_GT(reading, 20u) << "what was commanded in the other fold does not matter";
}

/// A long trajectory with a sensor of each kind, which report every 100 ms.
Log reportingLog(double seconds) {
    Trajectory trajectory{.name = "whole"};
    SensorLog sensor{.sensor = "all"};
    for (Nanoseconds t = 0; t <= fromSeconds(seconds); t += 100 * ms) {
        trajectory.commands.push_back({t, {0.1, 0}});
        trajectory.poses.push_back({t, {0.1 * toSeconds(t), 0, 0}});
        sensor.looks.push_back({t, {}});
        sensor.poses.push_back({t, {}});
        sensor.scans.push_back({t, 0, 0, {1}});
    }
    trajectory.sensors = {sensor};
    Log log;
    log.robots.push_back({"1", {trajectory}, {}});
    return log;
}

TEST(HeldOutTime, EachReportOfASensorIsInOnePartOrInAGuard) {
    const Log log = reportingLog(400);
    const HoldOut fourth{4, 1, 25, 2};
    const auto learned = partOf(log, fourth, LogPart::learned), heldOut = partOf(log, fourth, LogPart::heldOut);
    ASSERT_TRUE(learned && heldOut);
    const auto blocks = heldOutBlocks(log.robots[0].trajectories[0], fourth);
    ASSERT_EQ(blocks.size(), 4u);
    const auto timesIn = [](const Log& part, auto samples) {
        std::set<Nanoseconds> times;
        for (const Trajectory& trajectory : part.robots[0].trajectories)
            for (const auto& sample : trajectory.sensors.at(0).*samples) EXPECT_TRUE(times.insert(sample.time).second);
        return times;
    };
    const auto check = [&](auto samples) {
        const auto known = timesIn(*learned, samples), held = timesIn(*heldOut, samples);
        for (Nanoseconds t = 0; t <= 400 * second; t += 100 * ms) {
            bool inBlock = false, guarded = false;
            for (const auto& [begin, end] : blocks) {
                inBlock = inBlock || (t >= begin && t < end);
                guarded = guarded || (t > begin - 2 * second && t < end + 2 * second);
            }
            EXPECT_EQ(held.contains(t), inBlock) << t;
            EXPECT_EQ(known.contains(t), !guarded) << t;
        }
    };
    check(&SensorLog::looks);
    check(&SensorLog::poses);
    check(&SensorLog::scans);
}

TEST(HeldOutGroups, LearnedPartHasNoDataOfTheirTime) {
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

/// One drive of so many seconds: a command each 0.1 s, which tells its own instant, poses every 20 ms.
Trajectory longDrive(int seconds, int group = 0, Nanoseconds begin = 7000 * ms) {
    Trajectory trajectory;
    trajectory.name = "whole";
    trajectory.group = group;
    for (int i = 0; i <= 50 * seconds; ++i) {
        const Nanoseconds t = begin + i * 20 * ms;
        if (i % 5 == 0) {
            trajectory.commands.push_back({t, {toSeconds(t), 0}});
            trajectory.blips.push_back({t, {}});
            trajectory.measuredVelocity.push_back({t, {}});
            trajectory.measuredRotation.push_back({t, {}});
        }
        trajectory.poses.push_back({t, {0.1 * toSeconds(t), 0, 0}});
    }
    return trajectory;
}

Log logOf(std::vector<Trajectory> trajectories) {
    Log log;
    log.source = "drive.csv";
    log.robots.push_back({"1", std::move(trajectories), {}});
    return log;
}

TEST(HeldOutBlocks, AreExactlyTheShareOfALongTrajectory) {
    for (const int seconds : {100, 137, 220, 600, 900, 3601})
        for (const int every : {2, 3, 5})
            for (int offset = 0; offset < every; ++offset) {
                const auto blocks = heldOutBlocks(longDrive(seconds), {every, offset, 44});
                ASSERT_FALSE(blocks.empty()) << seconds << ' ' << every;
                double heldOut = 0;
                for (const auto& [begin, end] : blocks) {
                    heldOut += toSeconds(end - begin);
                    EXPECT_GE(end - begin, 19'999 * ms);
                    EXPECT_LE(end - begin, 66'001 * ms);
                    EXPECT_GE(begin, 7000 * ms);
                    EXPECT_LE(end, (7000 + 1000 * seconds) * ms);
                }
                EXPECT_NEAR(heldOut, double(seconds) / every, 1e-6) << seconds;
            }
    EXPECT_TRUE(heldOutBlocks(longDrive(99), {5, 0, 44}).empty()) << "blocks would be shorter than 20 s";
    EXPECT_TRUE(heldOutBlocks(longDrive(600), {5, 0}).empty()) << "by groups";
}

TEST(HeldOutBlocks, PartsAreAGuardApartAndLackNothingElse) {
    const HoldOut fifth{5, 1, 44, 3.25};
    const Trajectory whole = longDrive(600);
    const Log log = logOf({whole});
    const auto learned = partOf(log, fifth, LogPart::learned), heldOut = partOf(log, fifth, LogPart::heldOut);
    ASSERT_TRUE(learned && heldOut);
    const auto& pieces = learned->robots[0].trajectories;
    const auto& blocks = heldOut->robots[0].trajectories;
    ASSERT_EQ(blocks.size(), 3u);  // of 15 blocks of 40 s
    ASSERT_EQ(pieces.size(), 4u);
    std::set<Nanoseconds> kept, judged;
    std::set<int> groups;
    for (const Trajectory& piece : pieces) {
        EXPECT_EQ(piece.name, "whole");
        groups.insert(piece.group);
        for (const StampedPose& pose : piece.poses) kept.insert(pose.time);
    }
    EXPECT_EQ(groups.size(), 4u) << "so that folds can be divided among them";
    for (const Trajectory& block : blocks)
        for (const StampedPose& pose : block.poses) judged.insert(pose.time);
    EXPECT_EQ(judged.size(), 3u * 2000);
    for (std::size_t i = 0; i < 3; ++i) {
        const Nanoseconds begin = blocks[i].poses.front().time, end = begin + 40'000 * ms;
        EXPECT_EQ(begin, (7 + 40 + 200 * std::int64_t(i)) * 1000 * ms);
        EXPECT_LE(pieces[i].poses.back().time, begin - 3250 * ms);
        EXPECT_GT(pieces[i].poses.back().time, begin - 3250 * ms - 20 * ms);
        EXPECT_GE(pieces[i + 1].poses.front().time, end + 3250 * ms);
        EXPECT_LT(pieces[i + 1].poses.front().time, end + 3250 * ms + 20 * ms);
    }
    for (const StampedPose& pose : whole.poses) {
        const bool inGuard = !kept.count(pose.time) && !judged.count(pose.time);
        const double since = std::fmod(toSeconds(pose.time - 47'000 * ms) + 1000, 200);  // the first block's begin
        EXPECT_EQ(inGuard, (since > 196.75 + 1e-9) || (since >= 40 && since < 43.25 - 1e-9)) << since;
    }
}

TEST(HeldOutBlocks, LearnedPartHasNoDataOfTheirTime) {
    const HoldOut third{3, 0, 44, 2};
    Trajectory drive = longDrive(270);  // six blocks of 45 s; held out are 0 to 45 s and 135 to 180 s
    // Commands every 10 s alone: the one in force when a block ends was issued before.
    std::erase_if(drive.commands, [](const StampedCommand& c) { return (c.time / ms - 7000) % 10'000 != 0; });
    const Log log = logOf({drive});
    const auto learned = partOf(log, third, LogPart::learned), heldOut = partOf(log, third, LogPart::heldOut);
    ASSERT_TRUE(learned && heldOut);
    const auto& pieces = learned->robots[0].trajectories;
    ASSERT_EQ(pieces.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        const Nanoseconds end = (7000 + 45'000 + 135'000 * std::int64_t(i)) * ms;
        EXPECT_EQ(pieces[i].commands.front().time, end);
        // In force: issued 5 s before it, or then.
        EXPECT_DOUBLE_EQ(pieces[i].commands.front().command.v, toSeconds(end) - (i == 0 ? 5 : 0));
        EXPECT_GT(pieces[i].commands[1].time, end);
        EXPECT_GE(pieces[i].blips.front().time, end);
        EXPECT_GE(pieces[i].measuredVelocity.front().time, end);
        EXPECT_GE(pieces[i].measuredRotation.front().time, end);
    }
    for (const Trajectory& block : heldOut->robots[0].trajectories)
        EXPECT_EQ(block.commands.front().time, 7000 * ms) << "commands are known when they are given";
}

TEST(HeldOutBlocks, NoPatternOrChainReachesIntoThem) {
    const MotionNetwork network = velocityBlueprint({}, {"1"}, {.deadTimeV = 0.6, .deadTimeW = 0.6});
    const Nanoseconds memory = InputReader(network).lookBack(), chain = 2000 * ms;
    const HoldOut fifth{5, 2, 44, toSeconds(memory + chain)};
    const Log log = logOf({longDrive(600)});
    const auto learned = partOf(log, fifth, LogPart::learned);
    ASSERT_TRUE(learned);
    const auto samples = motionSamples(std::vector<Log>{*learned}, network, {.heldOut = fifth});
    ASSERT_TRUE(samples);
    std::set<int> folds;
    for (const SampleRun& run : samples->runs) {
        folds.insert(run.fold);
        const Nanoseconds first = samples->samples[run.first].start - memory;
        const Nanoseconds last = samples->samples[run.first + run.count - 1].start + 100 * ms;
        for (const auto& [begin, end] : heldOutBlocks(longDrive(600), fifth))
            EXPECT_TRUE(last <= begin || first >= end);
    }
    EXPECT_EQ(folds, (std::set{0, 1, 2, 3}));
}

TEST(HeldOutBlocks, ShortTrajectoriesBesideLongOnesAreHeldOutWhole) {
    const HoldOut half{2, 1, 44, 1};
    const Log log = logOf({longDrive(10, 0), longDrive(200, 4), longDrive(10, 1), longDrive(10, 2)});
    const auto learned = partOf(log, half, LogPart::learned), heldOut = partOf(log, half, LogPart::heldOut);
    ASSERT_TRUE(learned && heldOut);
    const auto lengths = [](const Log& part) {
        std::vector<int> seconds;
        for (const Trajectory& t : part.robots[0].trajectories)
            seconds.push_back(int(std::lround(toSeconds(t.poses.back().time - t.poses.front().time))));
        return seconds;
    };
    EXPECT_EQ(lengths(*heldOut), (std::vector{50, 50, 10}));
    EXPECT_EQ(lengths(*learned), (std::vector{10, 49, 48, 10}));
}

TEST(HoldOutOf, TakesGroupsWhereThereAreEnoughOtherwiseTime) {
    const std::vector<Log> windows{shortWindows(11)}, drive{logOf({longDrive(600)})};
    const std::vector<Log> both{shortWindows(11), logOf({longDrive(600)})};
    EXPECT_TRUE((*holdOutOf(windows, 0.2, 0, HoldOutBy::whatSuits) == HoldOut{5, 4}));
    EXPECT_TRUE((*holdOutOf(windows, 0.2, 2, HoldOutBy::groups) == HoldOut{5, 1}));
    EXPECT_TRUE((*holdOutOf(drive, 0.2, 0, HoldOutBy::whatSuits) == HoldOut{5, 4, 44}));
    EXPECT_TRUE((*holdOutOf(drive, 0.2, 3, HoldOutBy::time) == HoldOut{5, 2, 44}));
    EXPECT_TRUE((*holdOutOf(both, 0.2, 0, HoldOutBy::whatSuits) == HoldOut{5, 4, 44}));
    EXPECT_TRUE((*holdOutOf(drive, 0, 0, HoldOutBy::whatSuits) == HoldOut{}));
}

TEST(HoldOutOf, SaysWhyALogCannotBeDivided) {
    const std::vector<Log> drive{logOf({longDrive(600), longDrive(99)})}, brief{logOf({longDrive(99)})};
    const auto errorOf = [](const std::vector<Log>& logs, HoldOutBy by) {
        const auto holdOut = holdOutOf(logs, 0.2, 0, by);
        return holdOut ? "no error" : holdOut.error().message();
    };
    EXPECT_EQ(errorOf(drive, HoldOutBy::whatSuits), "no error");
    EXPECT_EQ(errorOf(drive, HoldOutBy::groups), "drive.csv: has no group of trajectories to hold out");
    EXPECT_EQ(errorOf(brief, HoldOutBy::time),
              "drive.csv: is too short to hold out one in 5 of its blocks of time: a trajectory needs 100 s with "
              "commands and ground truth, its longest has 99 s");
    EXPECT_EQ(errorOf(brief, HoldOutBy::whatSuits),
              "drive.csv: has no group of trajectories to hold out, one in 5, and is too short for blocks of time: a "
              "trajectory needs 100 s with commands and ground truth, its longest has 99 s");
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
