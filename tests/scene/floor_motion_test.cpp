#include "scene/floor_motion.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/scenes.h"

namespace mrose {
namespace {

const FloorSurface carpet{0.3, 0.6, 0.4, {}, {}};

ObjectState rolling(double vx, double vy) { return {{}, {vx, vy, 0}, {vx, vy}}; }

ObjectState after(ObjectState state, double seconds, double tick, const ObjectType& type = ballType(),
                  const FloorSurface& floor = carpet) {
    for (double t = 0; t < seconds - tick / 2; t += tick) state = afterFloorMotion(state, type, floor, 1, tick);
    return state;
}

double speed(const ObjectState& state) { return std::hypot(state.velocity_W.x, state.velocity_W.y); }

TEST(FloorMotion, BallRollsOutAfterVSquaredOverTwiceItsDeceleration) {
    const ObjectState rest = after(rolling(1.2, -0.5), 10, 0.02);
    EXPECT_EQ(speed(rest), 0);
    const double distance = 1.3 * 1.3 / (2 * 0.4);
    EXPECT_NEAR(rest.pose.x, distance * 1.2 / 1.3, 1e-12);
    EXPECT_NEAR(rest.pose.y, -distance * 0.5 / 1.3, 1e-12);
    EXPECT_EQ(rest.roll_W, Point{});
}

TEST(FloorMotion, SlidingBallRollsAtSixTenthsOfItsSpeed) {
    const ObjectState kicked{{}, {3, 0, 0}, {}};
    const double slipTime = 3 / (0.3 * gravity * (1 + 1.5));
    ObjectState state = afterFloorMotion(kicked, ballType(), {0.3, 0, 0, {}, {}}, 1, slipTime + 0.1);
    EXPECT_NEAR(state.velocity_W.x, 0.6 * 3, 1e-12);
    EXPECT_NEAR(state.roll_W.x, 0.6 * 3, 1e-12);
    EXPECT_NEAR(state.pose.x, 3 * slipTime - 0.3 * gravity * slipTime * slipTime / 2 + 0.1 * 1.8, 1e-12);
    state = afterFloorMotion(kicked, ballType(), carpet, 1, slipTime / 2);
    EXPECT_NEAR(state.velocity_W.x, 3 - 0.3 * gravity * slipTime / 2, 1e-12);
    EXPECT_LT(state.roll_W.x, state.velocity_W.x);
}

TEST(FloorMotion, BackspinCanBringABallBack) {
    const ObjectState state = after({{}, {0.5, 0, 0}, {-2, 0}}, 1, 0.02, ballType(), {0.3, 0, 0, {}, {}});
    // m v + (I / r2) u is what friction at the touching point cannot change.
    EXPECT_NEAR(state.velocity_W.x, (0.5 + 2.0 / 3 * -2) / (1 + 2.0 / 3), 1e-12);
    EXPECT_LT(state.velocity_W.x, 0);
}

TEST(FloorMotion, DoesNotDependOnTheTick) {
    const ObjectState start{{1, 2, 0}, {2, 1, 3}, {0.2, -0.4}};
    for (const ObjectType& type : {ballType(), boxType()}) {
        const ObjectState coarse = after(start, 0.5, 0.05, type), fine = after(start, 0.5, 0.001, type);
        EXPECT_NEAR(coarse.pose.x, fine.pose.x, 1e-12);
        EXPECT_NEAR(coarse.pose.y, fine.pose.y, 1e-12);
        EXPECT_NEAR(coarse.pose.heading, fine.pose.heading, 1e-12);
        EXPECT_NEAR(coarse.velocity_W.x, fine.velocity_W.x, 1e-12);
        EXPECT_NEAR(coarse.velocity_W.rotation, fine.velocity_W.rotation, 1e-12);
    }
}

TEST(FloorMotion, BoxSlidesByCoulombsLaw) {
    const ObjectState rest = after({{}, {0, 2, 0}, {}}, 2, 0.02, boxType());
    EXPECT_NEAR(rest.pose.y, 4 / (2 * 0.3 * gravity), 1e-12);
    EXPECT_EQ(speed(rest), 0);
}

/// A hammer's reference point lies beside its centre of mass, and circles about it.
TEST(FloorMotion, BodyTurnsAboutItsCentreOfMass) {
    ShapePart handle, head;
    handle.polygon = {{0, -0.02}, {0.3, -0.02}, {0.3, 0.02}, {0, 0.02}};
    head.polygon = {{0.3, -0.08}, {0.4, -0.08}, {0.4, 0.08}, {0.3, 0.08}};
    ObjectType hammer = boxType();
    hammer.shape = std::make_shared<const Shape>(Shape::fromParts("hammer", {handle, head}));
    const double arm = (0.3 * 0.04 * 0.15 + 0.1 * 0.16 * 0.35) / (0.3 * 0.04 + 0.1 * 0.16);
    // Its centre of mass goes at (1, 0.5) m/s.
    const ObjectState thrown{{}, {1, 0.5 - 3 * arm, 3}, {}};
    const ObjectState gone = after(thrown, 2, 0.02, hammer, {0, 0, 0, {}, {}});
    EXPECT_NEAR(gone.pose.x, arm + 2 - arm * std::cos(6), 1e-9);
    EXPECT_NEAR(gone.pose.y, 1 - arm * std::sin(6), 1e-9);
    EXPECT_NEAR(gone.velocity_W.x, 1 + 3 * arm * std::sin(6), 1e-9);
    EXPECT_NEAR(gone.velocity_W.y, 0.5 - 3 * arm * std::cos(6), 1e-9);
    const ObjectState rest = after(thrown, 3, 0.02, hammer);
    const Point centre = Placement(rest.pose).place({arm, 0}), gravityWay{1, 0.5};
    EXPECT_NEAR(centre.x, arm + length(gravityWay) / (2 * 0.3 * gravity), 1e-9);
    EXPECT_EQ(speed(rest), 0);
}

TEST(FloorMotion, WithoutFrictionNothingSlowsDown) {
    const ObjectState moving = after({{}, {1, 0, 2}, {0.3, 0}}, 3, 0.02, ballType(), {0, 0, 0, {}, {}});
    EXPECT_NEAR(moving.pose.x, 3, 1e-12);
    EXPECT_NEAR(moving.pose.heading, 6, 1e-12);
    EXPECT_EQ(moving.roll_W, (Point{0.3, 0}));
}

}  // namespace
}  // namespace mrose
