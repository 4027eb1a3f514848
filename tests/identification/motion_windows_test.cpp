#include "identification/motion_windows.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

/// A quarter of a turn a second on a circle, at 50 Hz, with nothing seen in (pauseBegin, pauseEnd).
Trajectory circle(double pauseBegin = 100, double pauseEnd = 100) {
    constexpr double v = 0.4, w = 1.5;
    Trajectory trajectory;
    for (int i = 0; i <= 300; ++i) {
        const double t = 0.02 * i;
        trajectory.commands.push_back({fromSeconds(t), {v, w}});
        if (t <= pauseBegin || t >= pauseEnd) trajectory.poses.push_back({fromSeconds(t), exp({v * t, 0, w * t})});
    }
    return trajectory;
}

TEST(MotionWindows, ArcIsMeasuredAlongItself) {
    // One pose to a point: the mean of several lies inside the arc.
    const MotionWindows moved = motionWindows(circle(), 0.4, 0.01);
    ASSERT_FALSE(moved.windows.empty());
    for (const auto& window : moved.windows) {
        const double duration = moved.times[moved.begin[window.to]] - moved.times[moved.begin[window.from]];
        EXPECT_NEAR(duration, 0.4, 0.021);
        EXPECT_NEAR(window.along, 0.4 * duration, 1e-8);
        EXPECT_NEAR(window.left, 0, 1e-8);
        EXPECT_NEAR(window.rotation, 1.5 * duration, 1e-8);
    }
}

TEST(MotionWindows, NoneSpansAPauseOfTheTruth) {
    const MotionWindows whole = motionWindows(circle()), broken = motionWindows(circle(3, 3.5));
    EXPECT_LT(broken.windows.size(), whole.windows.size());
    for (const auto& window : broken.windows) {
        const double from = broken.times[broken.begin[window.from]], to = broken.times[broken.begin[window.to]];
        EXPECT_TRUE(to < 3.01 || from > 3.49) << from << " to " << to;
    }
}

TEST(MotionWindows, BeginsASecondAfterTheFirstCommand) {
    EXPECT_GE(motionWindows(circle()).times.front(), 1);
    Trajectory mute = circle();
    mute.commands.clear();
    EXPECT_TRUE(motionWindows(mute).windows.empty());
}

}  // namespace
}  // namespace mrose
