#include "identification/drive_fit.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "logs/log_reader.h"
#include "support/test_data.h"
#include "world/noise.h"

namespace mrose {
namespace {

/// Windows of 2 s of a robot that follows the arcs of its drive.
Log arcs(const DifferentialDrive& real, const DifferentialDrive& readWith, double noise) {
    Log log;
    log.robots.resize(1);
    for (int i = 0; i < 60; ++i) {
        const auto draw = [&](std::uint32_t channel) { return uniformNoise({8, i, 0, channel}); };
        const double left = 6 * draw(0) - 1, right = 6 * draw(1) - 1;
        const Command body = real.toCommand(left, right);
        Trajectory window;
        window.group = i / 2;
        window.steady = i % 3 != 0;
        for (int k = 0; k <= 40; ++k) {
            const double t = 0.05 * k;
            const auto shake = [&](std::uint32_t channel) { return noise * normalNoise({9, i * 100 + k, 0, channel}); };
            window.commands.push_back({fromSeconds(t), readWith.toCommand(left, right)});
            const Pose pose = exp({body.v * t, 0, body.w * t});
            window.poses.push_back({fromSeconds(t), {pose.x + shake(0), pose.y + shake(1), pose.heading + shake(2)}});
        }
        log.robots[0].trajectories.push_back(window);
    }
    return log;
}

/// Median over motions of the position error at the end over the path, when the drive's arc is followed from the start.
double medianEndError(const std::vector<SteadyMotion>& motions, const DifferentialDrive& drive) {
    std::vector<double> errors;
    for (const SteadyMotion& motion : motions) {
        const Command body = drive.toCommand(motion.wheels.left, motion.wheels.right);
        const Pose end = exp({body.v * motion.duration, 0, body.w * motion.duration});
        errors.push_back(std::hypot(end.x - motion.end.x, end.y - motion.end.y) / motion.path);
    }
    std::sort(errors.begin(), errors.end());
    const std::size_t half = errors.size() / 2;
    return errors.size() % 2 == 1 ? errors[half] : (errors[half - 1] + errors[half]) / 2;
}

TEST(DriveFit, FindsThePlantedGeometryWhateverTheLogWasReadWith) {
    const DifferentialDrive real{0.14, 1.1}, readWith{0.2, 0.4};
    const auto motions = steadyMotions(arcs(real, readWith, 0), WheelSource::commands, readWith);
    EXPECT_EQ(motions.size(), 40u);
    const auto fit = fitDrive(motions);
    ASSERT_TRUE(fit) << fit.error().message();
    EXPECT_NEAR(fit->drive.wheelRadius, 0.14, 1e-9);
    EXPECT_NEAR(fit->drive.track, 1.1, 1e-8);
    EXPECT_NEAR(medianEndError(motions, real), 0, 1e-8);
    EXPECT_GT(medianEndError(motions, readWith), 0.1);
}

TEST(DriveFit, StandardErrorCoversTheNoise) {
    const auto fit = fitDrive(steadyMotions(arcs({0.14, 1.1}, {}, 0.02), WheelSource::commands));
    ASSERT_TRUE(fit);
    EXPECT_GT(fit->trackError, 0);
    EXPECT_LT(std::abs(fit->drive.wheelRadius - 0.14), 4 * fit->wheelRadiusError);
    EXPECT_LT(std::abs(fit->drive.track - 1.1), 4 * fit->trackError);
}

TEST(DriveFit, TooLittleMotionIsAnError) {
    EXPECT_EQ(fitDrive({}, "empty.csv").error().message(), "empty.csv: fewer than 3 stretches of steady motion");
    const std::vector<SteadyMotion> straight(5, SteadyMotion{{2, 2}, 2, {0.6, 0, 0}, 0.6, 0});
    EXPECT_EQ(fitDrive(straight, "a.csv").error().cause, "the wheels do not both drive and turn the robot");
}

TEST(DriveFit, HuskyReachesThePublishedExploration) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs beside the repository";
    const auto log = readLog(*data / "drive" / "husky_windows.csv");
    ASSERT_TRUE(log) << log.error().message();
    const auto told = steadyMotions(*log, WheelSource::commands), measured = steadyMotions(*log, WheelSource::measured);
    const auto fit = fitDrive(measured);
    ASSERT_TRUE(fit);
    // An independent exploration found 68 % for ideal kinematics and 22 % for a linear map.
    EXPECT_NEAR(medianEndError(told, DifferentialDrive{}), 0.68, 0.02);
    EXPECT_NEAR(medianEndError(measured, fit->drive), 0.22, 0.02);
    const auto commanded = fitDrive(told);
    ASSERT_TRUE(commanded);
    EXPECT_LT(medianEndError(told, commanded->drive), 0.32);
}

}  // namespace
}  // namespace mrose
