#include "logs/conditioning.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/units.h"

namespace mrose {
namespace {

/// A sample every 15 ms, with a moving command.
std::vector<StampedCommand> drive(std::size_t count) {
    std::vector<StampedCommand> commands;
    for (std::size_t i = 0; i < count; ++i) commands.push_back({static_cast<Nanoseconds>(i) * 15 * ms, {0.08, 0.4}});
    return commands;
}

/// A sample every 15 ms on a straight line at 0.1 m/s.
std::vector<StampedPose> track(std::size_t count) {
    std::vector<StampedPose> poses;
    for (std::size_t i = 0; i < count; ++i)
        poses.push_back({static_cast<Nanoseconds>(i) * 15 * ms, {0.0015 * static_cast<double>(i), 1, 0.5}});
    return poses;
}

template <class Sample>
void expectAscending(const std::vector<Sample>& samples) {
    for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_LT(samples[i - 1].time, samples[i].time) << i;
}

void expectNoDefects(const LogDefects& found) {
    EXPECT_EQ(found.outOfOrder, 0);
    EXPECT_EQ(found.duplicates, 0);
    EXPECT_EQ(found.blips, 0);
    EXPECT_EQ(found.poseOutliers, 0);
    EXPECT_EQ(found.headingWraps, 0);
    EXPECT_EQ(found.commandGaps, 0);
    EXPECT_EQ(found.poseGaps, 0);
}

TEST(Conditioning, LeavesCleanSamplesAlone) {
    LogDefects found;
    auto commands = drive(100);
    auto poses = track(100);
    conditionCommands(commands, {}, found);
    conditionPoses(poses, {}, found);
    EXPECT_EQ(commands.size(), 100u);
    EXPECT_EQ(poses.size(), 100u);
    expectNoDefects(found);
}

TEST(Conditioning, SortsStampsOutOfOrderAndCountsThem) {
    LogDefects found;
    auto commands = drive(100);
    for (const std::size_t i : {10u, 40u, 98u}) std::swap(commands[i], commands[i + 1]);
    conditionCommands(commands, {}, found);
    EXPECT_EQ(found.outOfOrder, 3);
    EXPECT_EQ(commands.size(), 100u);
    expectAscending(commands);
}

TEST(Conditioning, KeepsTheLastOfEqualStamps) {
    LogDefects found;
    auto commands = drive(50);
    commands[21].time = commands[20].time;
    commands[22].time = commands[20].time;
    commands[22].command.v = 0.05;
    conditionCommands(commands, {}, found);
    EXPECT_EQ(found.duplicates, 2);
    EXPECT_EQ(commands.size(), 48u);
    EXPECT_EQ(commands[20].command.v, 0.05);
    expectAscending(commands);
}

TEST(Conditioning, DropsSingleZeroCommandsBetweenEqualMovingOnes) {
    LogDefects found;
    auto commands = drive(100);
    for (const std::size_t i : {5u, 30u, 32u, 90u}) commands[i].command = {};
    std::vector<StampedCommand> blips;
    conditionCommands(commands, {}, found, &blips);
    EXPECT_EQ(found.blips, 4);
    ASSERT_EQ(blips.size(), 4u) << "kept elsewhere";
    EXPECT_EQ(blips[2].time, 32 * 15 * ms);
    EXPECT_EQ(blips[2].command, Command{});
    EXPECT_EQ(commands.size(), 96u);
    for (const auto& sample : commands) EXPECT_EQ(sample.command, (Command{0.08, 0.4}));
}

TEST(Conditioning, KeepsRealStops) {
    LogDefects found;
    auto commands = drive(100);
    commands[10].command = commands[11].command = {};  // two samples
    for (std::size_t i = 50; i < 100; ++i) commands[i].command.v = 0.02;
    commands[50].command = {};  // between different commands
    commands[70].command = {};  // held for long
    for (std::size_t i = 71; i < 100; ++i) commands[i].time += 100 * ms;
    commands[99].command = {};  // the last
    conditionCommands(commands, {}, found);
    EXPECT_EQ(found.blips, 0);
    EXPECT_EQ(commands.size(), 100u);
}

TEST(Conditioning, KeepsBlipsWhereToldTo) {
    LogDefects found;
    auto commands = drive(100);
    commands[5].command = {};
    conditionCommands(commands, {.dropBlips = false}, found);
    EXPECT_EQ(found.blips, 0);
    EXPECT_EQ(commands.size(), 100u);
}

TEST(Conditioning, CountsGapsBeyondTheLimitAndTheLongest) {
    LogDefects found;
    auto commands = drive(100);
    auto poses = track(100);
    for (std::size_t i = 20; i < 100; ++i) commands[i].time += 600 * ms;
    for (std::size_t i = 60; i < 100; ++i) commands[i].time += 900 * ms;
    for (std::size_t i = 80; i < 100; ++i) commands[i].time += 400 * ms;
    for (std::size_t i = 50; i < 100; ++i) poses[i].time += 300 * ms;
    for (std::size_t i = 70; i < 100; ++i) poses[i].time += 150 * ms;
    conditionCommands(commands, {}, found);
    conditionPoses(poses, {}, found);
    EXPECT_EQ(found.commandGaps, 2);
    EXPECT_DOUBLE_EQ(found.longestCommandGap, 0.915);
    EXPECT_EQ(found.poseGaps, 1);
    EXPECT_DOUBLE_EQ(found.longestPoseGap, 0.315);
}

TEST(Conditioning, DropsSinglePosesFarOffBothNeighbours) {
    LogDefects found;
    auto poses = track(100);
    poses[10].pose.x += 0.3;
    poses[40].pose.heading += 2;
    conditionPoses(poses, {}, found);
    EXPECT_EQ(found.poseOutliers, 2);
    EXPECT_EQ(poses.size(), 98u);
    for (const auto& sample : poses) EXPECT_NEAR(sample.pose.x, 0.1 * toSeconds(sample.time), 1e-12);
}

TEST(Conditioning, KeepsJumpsThatStay) {
    LogDefects found;
    auto poses = track(100);
    for (std::size_t i = 50; i < 100; ++i) poses[i].pose.y += 1;  // carried, or another frame
    conditionPoses(poses, {}, found);
    EXPECT_EQ(found.poseOutliers, 0);
    EXPECT_EQ(poses.size(), 100u);
}

TEST(Conditioning, UnwrapsHeadingsThroughSeveralTurns) {
    LogDefects found;
    auto poses = track(1000);
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].pose.heading = wrapAngle(3 - 0.02 * static_cast<double>(i));
    conditionPoses(poses, {}, found);
    EXPECT_EQ(found.headingWraps, 3);  // 20 rad backwards from 3 pass -pi, -3 pi and -5 pi
    EXPECT_EQ(found.poseOutliers, 0);
    for (std::size_t i = 0; i < poses.size(); ++i)
        EXPECT_NEAR(poses[i].pose.heading, 3 - 0.02 * static_cast<double>(i), 1e-12);
}

TEST(Conditioning, AWrapIsNoOutlier) {
    LogDefects found;
    auto poses = track(5);
    poses[2].pose.heading += 2 * std::numbers::pi;
    conditionPoses(poses, {}, found);
    EXPECT_EQ(found.poseOutliers, 0);
    EXPECT_EQ(found.headingWraps, 2);
    EXPECT_NEAR(poses[2].pose.heading, 0.5, 1e-15);
}

std::vector<Nanoseconds> seconds(std::initializer_list<double> stamps) {
    std::vector<Nanoseconds> times;
    for (const double stamp : stamps) times.push_back(fromSeconds(stamp));
    return times;
}

std::vector<Nanoseconds> regular(int count) {
    std::vector<Nanoseconds> times;
    for (int i = 0; i < count; ++i) times.push_back(i * 100 * ms);
    return times;
}

TEST(ClockReset, StampsOutOfOrderAreNone) {
    EXPECT_FALSE(findClockReset(seconds({})));
    EXPECT_FALSE(findClockReset(seconds({0, 1, 2, 1.5, 3, 4, 2, 5, 6})));
    EXPECT_FALSE(findClockReset(seconds({0, 1, 2, 3, 4, 3.5})));
    auto block = regular(1000);  // a block delivered late
    for (int i = 500; i < 520; ++i) block[static_cast<std::size_t>(i)] -= 3 * nanosecondsPerSecond;
    EXPECT_FALSE(findClockReset(block));
}

TEST(ClockReset, IsFoundWhereTheStampsNeverRecover) {
    auto times = regular(1000);
    for (std::size_t i = 600; i < 1000; ++i) times[i] -= 60 * nanosecondsPerSecond;
    const auto reset = findClockReset(times);
    ASSERT_TRUE(reset);
    EXPECT_EQ(reset->row, 600u);
    EXPECT_EQ(reset->latestBefore, 599u);
    EXPECT_EQ(reset->behind, 59'900 * ms);
}

TEST(ClockReset, IsFoundWhereTheClockRepeatsALargeShareAndRecovers) {
    auto times = regular(1000);
    for (std::size_t i = 600; i < 1000; ++i) times[i] -= 20 * nanosecondsPerSecond;
    EXPECT_TRUE(findClockReset(times));
}

TEST(ClockReset, IsFoundWhereTimeRunsBackwardsThroughout) {
    auto times = regular(20);
    std::reverse(times.begin(), times.end());
    const auto reset = findClockReset(times);
    ASSERT_TRUE(reset);
    EXPECT_EQ(reset->row, 1u);
    EXPECT_TRUE(findClockReset(seconds({2, 1})));
}

}  // namespace
}  // namespace mrose
