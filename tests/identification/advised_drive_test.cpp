#include "identification/advised_drive.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/point.h"
#include "identification/advice_trial.h"
#include "motion/network_fixture.h"
#include "synthetic/log_generator.h"

namespace mrose {
namespace {

/// It moves as it is commanded, within limits; what it knows is the log's.
struct Advised {
    Log log = *generateLog({DrivePattern::random, 4, 20}, 7);
    LearnedMotion motion;

    static MotionNetwork network() {
        MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::history);
        for (float& parameter : network.mlp.parameters) parameter /= 10;
        return network;
    }
    Advised() : motion(network()) {}
    Expected<AdvisedDrive> drive(const AdviceOptions& options) { return adviseDrive(motion, {&log, 1}, options); }
};

AdviceOptions shortAdvice() {
    AdviceOptions options;
    options.limits = {-0.1, 0.3, 1.2};
    options.duration = 30;
    options.candidates = 30;
    return options;
}

TEST(AdvisedDrive, BeginsAndEndsAtRestWithinLimitsAndTheSameEachTime) {
    Advised advised;
    const AdviceOptions options = shortAdvice();
    const auto drive = advised.drive(options);
    ASSERT_TRUE(drive) << drive.error().message();
    EXPECT_EQ(drive->duration, 30);
    ASSERT_GT(drive->commands.size(), 10u);
    EXPECT_EQ(drive->commands.front(), (StampedCommand{0, {}}));
    EXPECT_EQ(drive->commands.back().command, Command{});
    EXPECT_LE(drive->commands.back().time, fromSeconds(28.1));
    for (std::size_t i = 0; i < drive->commands.size(); ++i) {
        const auto& [time, command] = drive->commands[i];
        EXPECT_GE(command.v, options.limits.leastV);
        EXPECT_LE(command.v, options.limits.mostV);
        EXPECT_LE(std::abs(command.w), options.limits.mostW);
        EXPECT_TRUE(i == 0 || time > drive->commands[i - 1].time);
    }
    for (const Pose& corner : {drive->least, drive->most}) EXPECT_LE(length(position(corner)), 1.5 * options.radius);
    EXPECT_EQ(advised.drive(options)->commands, drive->commands);
}

TEST(AdvisedDrive, StaysWithinASmallArea) {
    Advised advised;
    AdviceOptions options = shortAdvice();
    options.radius = 0.5;
    const auto drive = advised.drive(options);
    ASSERT_TRUE(drive);
    EXPECT_LT(std::max({-drive->least.x, -drive->least.y, drive->most.x, drive->most.y}), 0.9);
}

/// Chosen among 30, manoeuvres come nearer to all that is within the limits than the first that come.
TEST(AdvisedDrive, ComesNearerToAllDrivingThanManoeuvresAtRandom) {
    Advised advised;
    AdviceOptions options = shortAdvice();
    const auto chosen = advised.drive(options);
    options.candidates = 1;
    const auto random = advised.drive(options);
    ASSERT_TRUE(chosen && random);
    EXPECT_EQ(chosen->farBefore, random->farBefore);
    EXPECT_LT(chosen->farAfter, random->farAfter);
    EXPECT_LT(random->farAfter, random->farBefore);
}

TEST(AdvisedDrive, RefusesLimitsWithoutMotionAndLogsWithoutPatterns) {
    Advised advised;
    AdviceOptions options = shortAdvice();
    options.limits = {};
    const auto still = advised.drive(options);
    ASSERT_FALSE(still);
    EXPECT_EQ(still.error().message(),
              "limits: allow no motion; expected logs whose commands move the robot, or wider limits");
    const auto nothing = adviseDrive(advised.motion, {}, shortAdvice());
    ASSERT_FALSE(nothing);
    const auto cancelled =
        adviseDrive(advised.motion, {&advised.log, 1}, shortAdvice(), [](double share) { return share < 0.5; });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().cause, "cancelled");
}

TEST(AdvisedDrive, LimitsOfLogsAreThoseOfTheirCommands) {
    Log log;
    log.robots.resize(1);
    log.robots[0].trajectories.resize(2);
    log.robots[0].trajectories[0].commands = {{0, {0.2, -0.7}}};
    log.robots[0].trajectories[1].commands = {{0, {-0.1, 0.4}}, {1, {0.3, 0}}};
    EXPECT_EQ(limitsOf({&log, 1}), (CommandLimits{-0.1, 0.3, 0.7}));
}

/// One of the trials of bench_advice, with quick learning.
TEST(AdvisedDrive, TeachesMoreThanRandomDriving) {
    const auto heldOut = generateLog({DrivePattern::random, 12, 14}, 4321);
    const AdviceTrial trial = adviceTrial(4, 150, *heldOut, false);
    EXPECT_LT(trial.advised.position, trial.before.position);
    EXPECT_LT(trial.advised.position, trial.random.position);
}

}  // namespace
}  // namespace mrose
