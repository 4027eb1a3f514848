#include "identification/kinematic_fit.h"

#include <gtest/gtest.h>

#include "identification/planted_log.h"
#include "logs/log_reader.h"
#include "support/test_data.h"

namespace mrose {
namespace {

TEST(KinematicFit, FindsThePlantedParameters) {
    const RobotLog robot = plantedRobot({.deadTimeV = 0.25, .deadTimeW = 0.12, .lagV = 0.1, .lagW = 0.06, .jitter = 0});
    const auto fit = fitKinematics({&robot, 1}, KinematicFit::dynamic);
    ASSERT_TRUE(fit) << fit.error().message();
    EXPECT_NEAR(fit->v.deadTime, 0.25, 0.005);
    EXPECT_NEAR(fit->v.lag, 0.1, 0.005);
    EXPECT_NEAR(fit->v.gain, 0.9, 0.005);
    EXPECT_NEAR(fit->v.bias, 0, 0.002);
    EXPECT_NEAR(fit->w.deadTime, 0.12, 0.005);
    EXPECT_NEAR(fit->w.lag, 0.06, 0.005);
    EXPECT_NEAR(fit->w.gain, 0.9, 0.005);
    EXPECT_NEAR(fit->w.bias, 0.02, 0.002);
    EXPECT_NEAR(fit->lateralPerRotation, 0, 0.002);
}

TEST(KinematicFit, FindsAPointAheadOfTheAxle) {
    RobotLog robot = plantedRobot({});
    for (StampedPose& stamped : robot.trajectories[0].poses) stamped.pose = stamped.pose * Pose{0.06, 0, 0};
    const auto fit = fitKinematics({&robot, 1}, KinematicFit::dynamic);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->lateralPerRotation, 0.06, 0.002);
}

TEST(KinematicFit, DeadTimeAloneStandsForTheLagToo) {
    const RobotLog robot = plantedRobot({.lagV = 0.06, .lagW = 0.06, .jitter = 0, .gain = 1, .biasW = 0});
    const auto fit = fitKinematics({&robot, 1}, KinematicFit::deadTime);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->v.lag, 0);
    EXPECT_EQ(fit->v.gain, 1);
    EXPECT_EQ(fit->w.bias, 0);
    EXPECT_NEAR(fit->v.deadTime, 0.26, 0.02);
    EXPECT_NEAR(fit->w.deadTime, 0.26, 0.02);
}

TEST(KinematicFit, ChannelThatNeverMovesKeepsItsDefaults) {
    const RobotLog robot = plantedRobot({.biasW = 0, .turns = false});
    const auto fit = fitKinematics({&robot, 1}, KinematicFit::dynamic);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->w, KinematicParameters::Channel{});
}

TEST(KinematicFit, LogWithoutTruthIsAnErrorThatNamesIt) {
    RobotLog robot = plantedRobot({.duration = 10});
    robot.trajectories[0].poses.clear();
    const auto fit = fitKinematics({&robot, 1}, KinematicFit::dynamic, "blind.csv");
    ASSERT_FALSE(fit);
    EXPECT_EQ(fit.error().message(), "blind.csv: too little ground truth beside commands");
}

TEST(KinematicFit, RealRobotsAreNearThePublishedExploration) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs beside the repository";
    const auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset6");
    ASSERT_TRUE(log) << log.error().message();
    const auto fit = fitKinematics(log->robots, KinematicFit::dynamic);
    ASSERT_TRUE(fit);
    // An independent exploration found 0.16 + 0.10 s and 0.10 + 0.14 s.
    EXPECT_NEAR(fit->v.deadTime + fit->v.lag, 0.26, 0.04);
    EXPECT_NEAR(fit->w.deadTime, 0.10, 0.02);
    EXPECT_NEAR(fit->w.lag, 0.14, 0.03);
}

}  // namespace
}  // namespace mrose
