#include "behaviour/rolling_ball.h"

#include <cmath>

#include <gtest/gtest.h>

namespace mrose {
namespace {

constexpr double deceleration = 0.4, radius = 0.11;

ConvexPiece box(double left, double bottom, double right, double top) {
    return *ConvexPiece::polygon({{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

TEST(RollingBall, GetsSlowerUntilItLies) {
    const RollingBall ball{{1, 2}, {0.6, 0.8}};
    const RollingBall later = ball.after(1.5, {});
    EXPECT_NEAR(distance(later.position, {1 + 0.6 * (1.5 - deceleration * 1.5 * 1.5 / 2),
                                          2 + 0.8 * (1.5 - deceleration * 1.5 * 1.5 / 2)}),
                0, 1e-12);
    EXPECT_NEAR(distance(later.velocity, {0.6 * (1 - deceleration * 1.5), 0.8 * (1 - deceleration * 1.5)}), 0, 1e-12);
    const RollingBall rest = ball.after(10, {});
    EXPECT_NEAR(distance(ball.position, rest.position), 1 / (2 * deceleration), 1e-12);
    EXPECT_EQ(length(rest.velocity), 0);
}

TEST(RollingBall, StopsBeforeAWallAndRollsOnAlongIt) {
    const FloorPlan wall({box(2, -9, 3, 9)});
    const RollingBall straight = RollingBall{{1, 0}, {2, 0}}.after(4, {&wall, radius});
    EXPECT_NEAR(distance(straight.position, {2 - radius, 0}), 0, 0.001);
    EXPECT_LT(length(straight.velocity), 1e-6);
    // At 45 degrees: what leads along the wall stays, and slows down by itself.
    const RollingBall slanting = RollingBall{{1, 0}, {1.5, 1.5}}.after(60, {&wall, radius});
    const double way = (1 - radius) * std::sqrt(2.0), speed = 1.5 * std::sqrt(2.0);
    const double along = std::sqrt((speed * speed - 2 * deceleration * way) / 2);
    EXPECT_NEAR(slanting.position.x, 2 - radius, 0.001);
    EXPECT_NEAR(slanting.position.y, 1 - radius + along * along / (2 * deceleration), 0.003);
    // Away from a wall in which it is believed to lie it rolls freely.
    EXPECT_EQ((RollingBall{{2.05, 0}, {-1, 0}}.after(1, {&wall, radius}).position),
              (RollingBall{{2.05, 0}, {-1, 0}}.after(1, {}).position));
}

TEST(RollingBall, LiesInACorner) {
    const FloorPlan corner({box(2, -9, 3, 9), box(-9, 1, 3, 2)});
    const RollingBall ball = RollingBall{{1, 0}, {2, 1.5}}.after(9, {&corner, radius});
    EXPECT_NEAR(distance(ball.position, {2 - radius, 1 - radius}), 0, 0.002);
    EXPECT_LT(length(ball.velocity), 1e-6);
}

}  // namespace
}  // namespace mrose
