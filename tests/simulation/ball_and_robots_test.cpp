// A ball among the robots that ship, driving, with their ball guides: it goes neither through them nor into them, and
// no robot can hold it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/contact_measures.h"
#include "support/shipped.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

ObjectType shippedBallType() {
    ObjectType type = ballType();
    type.shape = shippedShape("ball");
    return type;
}

/// Where the ball is as seen from a robot.
Point seenFrom(const RobotState& robot, const ObjectState& ball) {
    return Placement(robot.pose).placeBack(position(ball.pose));
}

constexpr double radius = 0.11;

/// How deep a disc is in a robot, m; negative outside.
double depthIn(const Shape& shape, const Point& middle_B, double discRadius) {
    double deepest = -10;
    for (const ConvexPiece& piece : shape.pieces)
        deepest = std::max(deepest, -distance(ConvexPiece::circle(middle_B, discRadius), piece));
    return deepest;
}

/// A ball that comes at a robot which drives anyhow, also towards it.
SmallWorld ballAt(const RobotDescription& robot, std::shared_ptr<const MotionModel> model, std::int64_t trial) {
    const auto draw = [&](std::uint32_t c) { return 2 * uniformNoise({8, trial, 0, c}) - 1; };
    SmallWorld world;
    const bool towards = trial % 2 == 0;
    const Command told{towards ? 0.5 : 0.5 * draw(1), draw(2)};
    world.robot(robot.type, {0, 0, towards ? 0.3 * draw(0) : pi * draw(0)}, std::make_shared<const Told>(told),
                std::move(model));
    // From about ahead of it, most at 6 m/s.
    const double from = 0.5 * draw(3), aside = 0.25 * draw(4);
    const double speed = trial % 3 == 0 ? 3.5 + 2.5 * draw(6) : 6;
    const Point direction{-std::cos(from), -std::sin(from)};
    const Point start = -3 * direction + aside * Point{-direction.y, direction.x};
    world.object(shippedBallType(), {start.x, start.y, 0}, {speed * direction.x, speed * direction.y, 20 * draw(5)});
    return world;
}

TEST(BallAndRobots, FastBallNeverGetsIntoADrivingRobotNorThrough) {
    for (const char* name : {"pioneer1", "nomad200", "create", "husky", "b21"}) {
        const RobotDescription robot = shippedRobot(name);
        const Shape& shape = *robot.type.shape;
        const auto own = motionOf(robot);
        int hits = 0;
        for (std::int64_t trial = 0; trial < 400; ++trial) {
            const Scenario scenario = ballAt(robot, trial % 4 == 0 ? ideal() : own, trial).scenario();
            WorldState state = scenario.initialState();
            StepBuffers buffers;
            StepTrace trace;
            bool touched = false;
            for (int k = 0; k < 100; ++k) {
                const Point before = seenFrom(state.robots[0], state.objects[0]);
                step(scenario, state, buffers, {}, &trace);
                touched = touched || trace.touchedObjects[0];
                const Point now = seenFrom(state.robots[0], state.objects[0]);
                ASSERT_LT(depthIn(shape, now, radius), 0.012) << name << ' ' << trial << ", tick " << k;
                // Nor does its middle cross a horn on the way from tick to tick.
                if (!touched || length(now) > 1) continue;
                for (double s = 0.05; s < 1; s += 0.05)
                    ASSERT_LT(depthIn(shape, before + s * (now - before), 1e-9), 0) << name << ' ' << trial;
            }
            hits += touched ? 1 : 0;
        }
        EXPECT_GT(hits, 350) << name;
    }
}

/// A Pioneer pushes the ball with its guide for two seconds, then does something else: where the ball is after three
/// more.
struct Carried {
    Point ball_B;          ///< as seen from the robot
    double backwards = 0;  ///< m/s, the fastest at which the ball was drawn against the way that it was pushed
    double pushed = 0;     ///< m, how far it had been pushed
};
Carried carried(const Command& then, const std::shared_ptr<const MotionModel>& model) {
    const RobotDescription robot = shippedRobot("pioneer1");
    SmallWorld world;
    world.robot(
        robot.type, {0, 0, 0},
        std::make_shared<const Told>(std::vector<StampedCommand>{{0, {0.4, 0}}, {2 * nanosecondsPerSecond, then}}),
        withNoise(model, {}));
    world.object(shippedBallType(), {0.29, 0, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 100);
    Carried result;
    result.pushed = state.objects[0].pose.x - 0.29;
    for (int k = 0; k < 150; ++k) {
        run(scenario, state, 1);
        result.backwards = std::max(result.backwards, -state.objects[0].velocity_W.x);
    }
    result.ball_B = seenFrom(state.robots[0], state.objects[0]);
    return result;
}

bool inTheGuide(const Point& ball_B) { return ball_B.x > 0 && ball_B.x < 0.35 && std::abs(ball_B.y) < 0.2; }

TEST(BallAndRobots, BallGuideCannotHoldTheBall) {
    for (const auto& model : {ideal(), motionOf(shippedRobot("pioneer1"))}) {
        const Carried on = carried({0.4, 0}, model);
        EXPECT_TRUE(inTheGuide(on.ball_B)) << "it can push it";
        EXPECT_GT(on.pushed, 0.4);
        for (const double speed : {-0.05, -0.3, -0.5}) {
            const Carried back = carried({speed, 0}, model);
            EXPECT_LT(back.backwards, 1e-6) << "the ball is never drawn back";
            EXPECT_FALSE(inTheGuide(back.ball_B)) << speed << ": " << back.ball_B.x << ' ' << back.ball_B.y;
        }
        for (const double turn : {-4.0, -2.0, 2.0, 4.0}) {
            const Carried spun = carried({0, turn}, model);
            EXPECT_FALSE(inTheGuide(spun.ball_B)) << turn << ": " << spun.ball_B.x << ' ' << spun.ball_B.y;
        }
        const Carried stopped = carried({}, model);
        EXPECT_GT(stopped.ball_B.x, 0.32) << "it rolls on";
    }
}

/// Two square robots that drive at each other, a ball `aside` m off the line between them.
SmallWorld pressedBall(double speed, double aside) {
    SmallWorld world;
    const auto drive = std::make_shared<const Told>(Command{speed, 0});
    world.robot(squareRobot(), {-0.8, 0, 0}, drive, ideal());
    world.robot(squareRobot(), {0.8, 0, pi}, drive, ideal());
    world.object(ballType(), {0, aside, 0});
    return world;
}

TEST(BallAndRobots, BallBetweenRobotsThatPressStaysBetweenThem) {
    for (const double speed : {0.3, 1.0, 2.0}) {
        const Scenario scenario = pressedBall(speed, 0).scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        for (int k = 0; k < 500; ++k) {
            step(scenario, state, buffers);
            ASSERT_GE(leastGap(scenario, state), -0.0005) << speed << ", tick " << k;
        }
        EXPECT_LT(std::abs(state.objects[0].pose.x), 0.001) << speed;
        EXPECT_LT(std::abs(state.objects[0].pose.y), 0.001) << speed;
        EXPECT_LT(gapBetween(scenario, state, 0, 2), 0.005) << "the robot is at the ball";
        EXPECT_LT(gapBetween(scenario, state, 1, 2), 0.005);
    }
}

/// 3 mm aside they turn about it and let it out: into nobody.
TEST(BallAndRobots, BallAsideOfRobotsThatPressIsLetOutButEntersNothing) {
    for (const double speed : {0.3, 1.0, 2.0}) {
        const Scenario scenario = pressedBall(speed, 0.003).scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        for (int k = 0; k < 500; ++k) {
            step(scenario, state, buffers);
            ASSERT_GE(leastGap(scenario, state), -0.0005) << speed << ", tick " << k;
        }
    }
}

}  // namespace
}  // namespace mrose
