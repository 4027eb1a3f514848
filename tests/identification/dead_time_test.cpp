#include "identification/dead_time.h"

#include <gtest/gtest.h>

#include "identification/planted_log.h"
#include "logs/log_reader.h"
#include "support/test_data.h"

namespace mrose {
namespace {

DeadTimes identify(const RobotLog& robot) { return identifyDeadTimes({&robot, 1}); }

/// Dead times from 0 to 400 ms with lags from 0 to 0.2 s, other ones for each channel.
std::vector<Plant> plants(double jitter) {
    std::vector<Plant> result;
    for (const double deadTime : {0.0, 0.05, 0.13, 0.2, 0.3, 0.4})
        for (const double lag : {0.0, 0.07, 0.2}) {
            Plant plant{.deadTimeV = deadTime, .deadTimeW = 0.4 - deadTime, .lagV = lag, .lagW = 0.2 - lag};
            plant.jitter = jitter;
            plant.seed = 17 + result.size();
            result.push_back(plant);
        }
    return result;
}

TEST(DeadTime, PlantedDeadTimesOfJitteredCommandsAreFoundWithin15Milliseconds) {
    int honest = 0, channels = 0;
    for (const double jitter : {0.0, 0.02, 0.04})
        for (const Plant& plant : plants(jitter)) {
            const DeadTimes found = identify(plantedRobot(plant));
            const auto check = [&](const ChannelDelay& delay, double planted, double lag) {
                const double expected = meanDelay(planted, jitter);
                ASSERT_TRUE(delay.identified) << delay.reason;
                EXPECT_NEAR(delay.deadTime, expected, 0.015) << "jitter " << jitter << " lag " << lag;
                EXPECT_NEAR(delay.lag, lag, 0.02);
                EXPECT_GT(delay.explained, 0.95);
                honest += std::abs(delay.deadTime - expected) <= 3 * delay.deadTimeError;
                ++channels;
            };
            check(found.v, plant.deadTimeV, plant.lagV);
            check(found.w, plant.deadTimeW, plant.lagW);
        }
    EXPECT_GE(honest, 0.9 * channels) << "of " << channels;
}

TEST(DeadTime, JitterIsToldApartFromLag) {
    const DeadTimes jittered = identify(plantedRobot({.lagV = 0, .lagW = 0, .jitter = 0.04}));
    EXPECT_NEAR(jittered.w.jitter, 0.04, 0.01);
    EXPECT_LT(jittered.w.lag, 0.02);
    const DeadTimes lagged = identify(plantedRobot({.lagV = 0.1, .lagW = 0.1, .jitter = 0}));
    EXPECT_LT(lagged.w.jitter, 0.01);
    EXPECT_NEAR(lagged.w.lag, 0.1, 0.01);
}

TEST(DeadTime, UnknownGainBiasScrubAndGapsDoNotMoveIt) {
    for (const double gain : {0.6, 1.3}) {
        const Plant plant{.gain = gain, .biasW = 0.1, .scrub = 0.25, .resting = 20};
        const DeadTimes found = identify(plantedRobot(plant));
        EXPECT_NEAR(found.v.deadTime, 0.2, 0.015);
        EXPECT_NEAR(found.w.deadTime, 0.2, 0.015);
    }
}

TEST(DeadTime, BlipsOfTheCommandDoNotMoveIt) {
    RobotLog robot = plantedRobot({});
    auto& commands = robot.trajectories[0].commands;
    for (std::size_t i = 50; i + 1 < commands.size(); i += 97) commands[i].command = {};
    const DeadTimes found = identify(robot);
    EXPECT_NEAR(found.v.deadTime, 0.2, 0.015);
    EXPECT_NEAR(found.w.deadTime, 0.2, 0.015);
}

TEST(DeadTime, MoreNoiseGivesALargerStandardError) {
    const Plant quiet{.lagW = 0.1, .headingNoise = 0.001, .duration = 100},
        loud{.lagW = 0.1, .headingNoise = 0.05, .duration = 100};
    EXPECT_GT(identify(plantedRobot(loud)).w.deadTimeError, 2 * identify(plantedRobot(quiet)).w.deadTimeError);
}

TEST(DeadTime, ChannelThatNeverMovesIsNotIdentifiable) {
    const DeadTimes straight = identify(plantedRobot({.biasW = 0, .turns = false}));
    EXPECT_TRUE(straight.v.identified) << straight.v.reason;
    EXPECT_FALSE(straight.w.identified);
    EXPECT_EQ(straight.w.quality(), "not identifiable: the command changes only 0 times");
    const DeadTimes spinning = identify(plantedRobot({.drives = false}));
    EXPECT_FALSE(spinning.v.identified);
    EXPECT_TRUE(spinning.w.identified) << spinning.w.reason;
}

TEST(DeadTime, MotionThatDoesNotFollowTheCommandIsNotIdentifiable) {
    RobotLog robot = plantedRobot({.seed = 3});
    robot.trajectories[0].poses = plantedTrajectory({.seed = 4}).poses;
    const DeadTimes found = identify(robot);
    EXPECT_FALSE(found.v.identified);
    EXPECT_FALSE(found.w.identified);
}

TEST(DeadTime, LogWithoutTruthOrCommandsIsNotIdentifiable) {
    RobotLog robot = plantedRobot({.duration = 20});
    RobotLog blind = robot, mute = robot;
    blind.trajectories[0].poses.clear();
    mute.trajectories[0].commands.clear();
    EXPECT_EQ(identify(blind).v.reason, "no ground truth");
    EXPECT_EQ(identify(mute).v.reason, "too little ground truth beside commands");
    EXPECT_FALSE(identifyDeadTimes({}).w.identified);
}

TEST(DeadTime, RealRobotsAgreeWithCrossCorrelation) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs beside the repository";
    const auto log = readLog(*data / "mrclam" / "MRCLAM_Dataset6");
    ASSERT_TRUE(log) << log.error().message();
    // Cross-correlation gives 0.22-0.24 s for v and 0.16-0.20 s for w, which is dead time and lag together.
    const DeadTimes pooled = identifyDeadTimes(log->robots);
    EXPECT_NEAR(pooled.v.deadTime + pooled.v.lag, 0.23, 0.02);
    EXPECT_NEAR(pooled.w.deadTime + pooled.w.lag, 0.18, 0.02);
    // Commands act as if sampled each 0.235 s: a uniform spread with this standard deviation.
    EXPECT_NEAR(pooled.v.jitter, 0.235 / std::sqrt(12.0), 0.015);
    EXPECT_NEAR(pooled.w.jitter, 0.235 / std::sqrt(12.0), 0.015);
    const std::vector<DeadTimes> each = identifyEachDeadTime(*log);
    ASSERT_EQ(each.size(), 5u);
    const DeadTimes third = identify(log->robots[2]);
    EXPECT_EQ(each[2].v.deadTime, third.v.deadTime);
    EXPECT_EQ(each[2].w.lag, third.w.lag);
}

}  // namespace
}  // namespace mrose
