#include "geometry/pose.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace mrose {
namespace {

using std::numbers::pi;

void expectNear(const Pose& a, const Pose& b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.heading, b.heading, tolerance);
}

TEST(Pose, ComposedWithItsInverseIsTheIdentity) {
    const Pose p{1.2, -3.4, 2.5};
    expectNear(p * inverse(p), {}, 1e-15);
    expectNear(inverse(p) * p, {}, 1e-15);
}

TEST(Pose, RelativeIsInverseTimesPose) {
    const Pose a{1, 2, 0.7}, b{-0.3, 4, -2.9};
    expectNear(relative(a, b), inverse(a) * b, 1e-15);
    expectNear(a * relative(a, b), b, 1e-15);
}

TEST(Exp, QuarterArcEndsAtItsClosedForm) {
    const double radius = 0.8;
    expectNear(exp({radius * pi / 2, 0, pi / 2}), {radius, radius, pi / 2}, 1e-15);
}

TEST(Exp, EqualsManySmallStraightSteps) {
    const Twist twist{0.5, -0.2, 1.9};
    const int steps = 20000;
    Pose pose;
    for (int i = 0; i < steps; ++i) {
        // Midpoint rule: second order, so 20000 steps leave about 1e-10.
        pose = pose * Pose{0, 0, twist.rotation / steps / 2} * Pose{twist.x / steps, twist.y / steps, 0} *
               Pose{0, 0, twist.rotation / steps / 2};
    }
    expectNear(exp(twist), pose, 1e-8);
}

TEST(Log, InvertsExpAtEveryRotation) {
    for (const double rotation : {0.0, 1e-12, 1e-5, 9.9e-5, 1.01e-4, 0.3, 1.5, 3.1, pi, -3.1, -1e-7, 4.0}) {
        const Twist twist{0.31, -0.17, rotation};
        const Twist back = log(exp(twist));
        EXPECT_NEAR(back.x, twist.x, 1e-13) << rotation;
        EXPECT_NEAR(back.y, twist.y, 1e-13) << rotation;
        EXPECT_DOUBLE_EQ(back.rotation, rotation);
    }
}

TEST(WrapAngle, LiesInTheHalfOpenTurn) {
    EXPECT_DOUBLE_EQ(wrapAngle(pi), pi);
    EXPECT_DOUBLE_EQ(wrapAngle(-pi), pi);
    EXPECT_NEAR(wrapAngle(7.0), 7.0 - 2 * pi, 1e-15);
    EXPECT_NEAR(wrapAngle(-100.0), -100.0 + 32 * pi, 1e-13);
    for (double a = -50; a < 50; a += 0.37) {
        const double wrapped = wrapAngle(a);
        EXPECT_GT(wrapped, -pi);
        EXPECT_LE(wrapped, pi);
        EXPECT_NEAR(std::sin(wrapped), std::sin(a), 1e-13);
        EXPECT_NEAR(std::cos(wrapped), std::cos(a), 1e-13);
    }
}

}  // namespace
}  // namespace mrose
