#include "simulation/motion_path.h"

#include <cmath>

#include <gtest/gtest.h>

namespace mrose {
namespace {

constexpr double period = 0.1;

/// Velocity in the body's frame by differences of the path itself.
Twist differenced(const MotionSegment& segment, double share) {
    constexpr double h = 1e-6;
    const Pose before = at(segment, share - h, period).pose, after = at(segment, share + h, period).pose;
    const Twist step = log(relative(before, after));
    const double perSecond = 1 / (2 * h * period);
    return {step.x * perSecond, step.y * perSecond, step.rotation * perSecond};
}

const MotionStep turning{{0.07, 0.011, 0.35}, {0.9, 4.2}};

TEST(MotionPath, EndsAtThePredictionAndItsVelocity) {
    const Pose start{3, -2, 1.2};
    const MotionSegment segment = beginSegment(start, {0.4, 0.05, 2.5}, turning, 7, period);
    EXPECT_EQ(at(segment, 1, period).pose, start * turning.increment);
    EXPECT_EQ(at(segment, 1, period).velocity_B, (Twist{0.9, 0, 4.2}));
    const Pose first = at(segment, 0, period).pose;
    EXPECT_NEAR(first.x, start.x, 1e-15);
    EXPECT_NEAR(first.heading, start.heading, 1e-15);
    // Just before its end it is where it ends: no jump hides behind the exact last point.
    const Pose last = at(segment, 1 - 1e-12, period).pose, end = start * turning.increment;
    EXPECT_NEAR(last.x, end.x, 1e-11);
    EXPECT_NEAR(last.y, end.y, 1e-11);
    EXPECT_NEAR(last.heading, end.heading, 1e-11);
}

TEST(MotionPath, VelocityIsThePathsOwnAndHasNoSteps) {
    for (const double rotation : {0.35, 1e-3, 9e-4, 0.0, -0.8}) {
        const MotionStep step{{0.07, 0.011, rotation}, {0.9, 4.2}};
        const MotionSegment segment = beginSegment({3, -2, 1.2}, {0.4, 0, 2.5}, step, 0, period);
        for (const double share : {0.001, 0.2, 0.5, 0.8, 0.999}) {
            const Twist told = at(segment, share, period).velocity_B, seen = differenced(segment, share);
            EXPECT_NEAR(told.x, seen.x, 1e-6) << rotation << ' ' << share;
            EXPECT_NEAR(told.y, seen.y, 1e-6);
            EXPECT_NEAR(told.rotation, seen.rotation, 1e-6);
        }
        const Twist first = at(segment, 0, period).velocity_B, last = at(segment, 1 - 1e-12, period).velocity_B;
        EXPECT_NEAR(first.x, 0.4, 1e-12);
        EXPECT_NEAR(first.rotation, 2.5, 1e-12);
        EXPECT_NEAR(last.x, 0.9, 1e-9);
        EXPECT_NEAR(last.y, 0, 1e-9);
        EXPECT_NEAR(last.rotation, 4.2, 1e-9);
    }
}

TEST(MotionPath, SteadyMotionFollowsItsArc) {
    const Twist arc{0.05, 0, 0.2};
    const MotionStep step{exp(arc), {0.5, 2}};
    const MotionSegment segment = beginSegment({}, {0.5, 0, 2}, step, 0, period);
    for (const double share : {0.25, 0.5, 0.9}) {
        const Pose expected = exp({share * arc.x, 0, share * arc.rotation}), got = at(segment, share, period).pose;
        EXPECT_NEAR(got.x, expected.x, 1e-15);
        EXPECT_NEAR(got.y, expected.y, 1e-15);
        EXPECT_NEAR(got.heading, expected.heading, 1e-15);
    }
}

TEST(MotionPath, PushedRobotGoesOnFromWhereItWasPushedTo) {
    MotionSegment segment = beginSegment({1, 1, 0.3}, {0.4, 0, 2.5}, turning, 0, period);
    const Pose middle = at(segment, 0.4, period).pose, end = at(segment, 1, period).pose;
    const Pose pushed{2, -1, 2};
    moveTo(segment, 0.4, pushed);
    const Pose now = at(segment, 0.4, period).pose;
    EXPECT_NEAR(now.x, pushed.x, 1e-14);
    EXPECT_NEAR(now.heading, pushed.heading, 1e-14);
    const Pose rest = relative(middle, end), restNow = relative(pushed, at(segment, 1, period).pose);
    EXPECT_NEAR(restNow.x, rest.x, 1e-14);
    EXPECT_NEAR(restNow.y, rest.y, 1e-14);
    EXPECT_NEAR(restNow.heading, rest.heading, 1e-14);
}

}  // namespace
}  // namespace mrose
