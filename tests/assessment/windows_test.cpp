#include "assessment/windows.h"

#include <gtest/gtest.h>

#include "assessment/test_models.h"

namespace mrose {
namespace {

TEST(Windows, LieEndToEndFromTwoSecondsAfterTheGridsBegin) {
    const Log log = logOf({obedientTrajectory(0, 60 * second, straightOn)});
    const auto windows = findWindows(log);
    ASSERT_TRUE(windows);
    // The grid runs over [1.5, 59) s: 575 instants; starts at 20, 120, ... below 575 - 101.
    ASSERT_EQ(windows->size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ((*windows)[i].start, 3'500'000'000 + static_cast<Nanoseconds>(i) * 10 * second);
        EXPECT_EQ((*windows)[i].steps(), 100);
        EXPECT_NEAR((*windows)[i].path, 1.0, 1e-9);
        EXPECT_NEAR((*windows)[i].rotation, 0, 1e-9);
        EXPECT_NEAR((*windows)[i].measuredVelocity->velocity.v, 0.1, 1e-9);
    }
}

TEST(Windows, AreLeftOutWhereTheRobotHardlyMovesButStillCounted) {
    const auto command = [](double t) { return t > 13 && t < 24 ? Command{0.029, 0.099} : Command{0.1, 0}; };
    const auto windows = findWindows(logOf({obedientTrajectory(0, 60 * second, command)}));
    ASSERT_TRUE(windows);
    ASSERT_EQ(windows->size(), 4u);
    EXPECT_EQ((*windows)[0].start, 3'500'000'000);
    EXPECT_EQ((*windows)[1].start, 23'500'000'000);
}

TEST(Windows, AreLeftOutWhereTheTruthHasAGap) {
    Trajectory trajectory = obedientTrajectory(0, 60 * second, straightOn);
    std::erase_if(trajectory.poses,
                  [](const StampedPose& p) { return p.time > 20 * second && p.time < 20.3 * second; });
    const auto windows = findWindows(logOf({trajectory}));
    ASSERT_TRUE(windows);
    ASSERT_EQ(windows->size(), 4u);
    EXPECT_EQ((*windows)[1].start, 23'500'000'000);
}

TEST(Windows, ShorterHorizonsGiveMoreOfThem) {
    const Log log = logOf({obedientTrajectory(0, 60 * second, straightOn)});
    const auto windows = findWindows(log, {}, {.horizon = 2 * second});
    ASSERT_TRUE(windows);
    EXPECT_EQ(windows->size(), 27u);  // (575 - 21 - 20) / 20, rounded up
    EXPECT_NEAR(windows->front().path, 0.2, 1e-9);
}

TEST(Windows, AShortTrajectoryIsOneWindowThatEndsWithIt) {
    const auto windows = findWindows(logOf({obedientTrajectory(second, 12 * second, straightOn)}));
    ASSERT_TRUE(windows);
    ASSERT_EQ(windows->size(), 1u);
    EXPECT_EQ(windows->front().start, 3 * second);
    EXPECT_EQ(windows->front().steps(), 100);
    EXPECT_NEAR(windows->front().path, 1.0, 1e-9);
    EXPECT_TRUE(windows->front().measuredVelocity);
}

TEST(Windows, ATrajectoryShorterThanTheHorizonIsOneWindowAsAWhole) {
    const auto windows = findWindows(logOf({obedientTrajectory(5, 1'950'000'000, straightOn, 20)}));
    ASSERT_TRUE(windows);
    ASSERT_EQ(windows->size(), 1u);
    EXPECT_EQ(windows->front().start, 5);
    EXPECT_EQ(windows->front().steps(), 19);
    EXPECT_FALSE(windows->front().measuredVelocity);
    EXPECT_NEAR(windows->front().path, 0.19, 1e-9);
}

TEST(Windows, SayWhyThereAreNone) {
    Trajectory blind = obedientTrajectory(0, 60 * second, straightOn);
    blind.poses.clear();
    const auto none = findWindows(logOf({blind, obedientTrajectory(0, second / 2, straightOn),
                                         obedientTrajectory(0, 30 * second, [](double) { return Command{}; })}));
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message(),
              "made-up: has no window of 10 s to predict: 1 without ground truth, 1 too short, 2 in which the robot "
              "hardly moves");
    const auto unknown = findWindows(logOf({}), {"9"});
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().message(), "made-up: has no robot 9");
}

TEST(Travelled, SumsOverHalfSecondsAndTheRemainder) {
    std::vector<Pose> poses;
    for (int i = 0; i <= 13; ++i) poses.push_back({0.01 * i, i % 5 == 0 ? 0.0 : 0.4, -0.1 * i});
    const Travel travel = travelled(poses, 100'000'000);
    EXPECT_NEAR(travel.path, 0.05 + 0.05 + std::hypot(0.03, 0.4), 1e-12);
    EXPECT_NEAR(travel.rotation, 1.3, 1e-12);
}

Manoeuvre kindOf(Command (*commandAt)(double)) {
    const RobotLog robot{"r", {obedientTrajectory(0, 20 * second, commandAt)}, {}};
    return classify(robot.trajectories[0], 5 * second, 15 * second, commandScale(robot));
}

TEST(Manoeuvre, IsToldFromTheCommands) {
    EXPECT_EQ(kindOf([](double) { return Command{0.4, 0.04}; }), Manoeuvre::straight);
    EXPECT_EQ(kindOf([](double) { return Command{0.4, 0.06}; }), Manoeuvre::turning);
    EXPECT_EQ(kindOf([](double t) { return Command{t < 10 ? 0.4 : 0.0, 0}; }), Manoeuvre::hardSwitch);
    EXPECT_EQ(kindOf([](double t) { return Command{0.1, t < 10 ? 0.9 : 0.0}; }), Manoeuvre::hardSwitch);
    EXPECT_EQ(kindOf([](double t) { return Command{t < 10 ? 0.4 : -0.11, 0}; }), Manoeuvre::hardSwitch);
    // Half speed to zero, a slow stop and a blip are none.
    EXPECT_EQ(kindOf([](double t) { return Command{t < 1 ? 0.4 : t < 10 ? 0.2 : 0.0, 0}; }), Manoeuvre::straight);
    EXPECT_EQ(kindOf([](double t) { return Command{std::clamp((12 - t) * 0.1, 0.0, 0.4), 0}; }), Manoeuvre::straight);
    EXPECT_EQ(kindOf([](double t) { return Command{t > 10 && t < 10.15 ? 0.0 : 0.4, 0}; }), Manoeuvre::straight);
}

}  // namespace
}  // namespace mrose
