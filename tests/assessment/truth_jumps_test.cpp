#include "assessment/truth_jumps.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "assessment/test_models.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

/// Tracked so often in a second, in bends of up to 1.5 rad/s; from 10 s on turned by `step` rad.
Trajectory turnedBy(double step, int rate, double noise = 0.001) {
    Trajectory trajectory = obedientTrajectory(
        0, 20 * second,
        [](double t) {
            return Command{0.2, 1.5 * std::sin(2 * t)};
        },
        rate);
    std::int64_t index = 0;
    for (StampedPose& stamped : trajectory.poses) {
        stamped.pose.heading += noise * normalNoise({1, index++, 0, 0});
        if (stamped.time >= 10 * second) stamped.pose.heading += step;
        stamped.pose.heading = wrapAngle(stamped.pose.heading);
    }
    return trajectory;
}

TEST(HeadingSteps, AreThoseOfTheTrackerWhateverTheRobotTurns) {
    for (const double step : {0.03, -0.03, 0.3, 3.0}) {
        const auto steps = headingSteps(turnedBy(step, 50));
        ASSERT_EQ(steps.size(), 1u) << step;
        EXPECT_EQ(steps[0].time, 10 * second);
        EXPECT_EQ(steps[0].known, 10 * second + 100 * ms) << "five poses later";
    }
    EXPECT_TRUE(headingSteps(turnedBy(0.004, 50)).empty());
}

TEST(HeadingSteps, AreNoNoiseOfTheTracker) {
    for (const double noise : {0.005, 0.02}) {
        const auto steps = headingSteps(turnedBy(20 * noise, 50, noise));
        const auto late = std::ranges::count_if(steps, [](const HeadingStep& step) { return step.time > 8 * second; });
        EXPECT_EQ(late, 1) << "once it is known how much there is";
    }
}

/// A tracker that repeats a pose until it knows the next one.
TEST(HeadingSteps, AreNoStairs) {
    Trajectory stairs = turnedBy(0, 50);
    for (std::size_t i = 0; i < stairs.poses.size(); ++i) stairs.poses[i].pose = stairs.poses[i - i % 5].pose;
    EXPECT_TRUE(headingSteps(stairs).empty());
}

TEST(HeadingSteps, AreNotToldOfATrackerThatIsSlow) {
    EXPECT_TRUE(headingSteps(turnedBy(0.3, 10)).empty());
    EXPECT_TRUE(headingSteps({}).empty());
}

}  // namespace
}  // namespace mrose
