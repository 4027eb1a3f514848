// Hits that pass on within a tick: bodies are sent farther than they were planned to go, into others and thin walls,
// and enter nothing.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/contact_measures.h"
#include "support/outlines.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr double discRadius = 0.11;  // m
constexpr double mayEnter = 0.001;   // m
constexpr double thinWall = 0.02;    // m

/// Ice with one thin wall across the x axis, its near side at `x`.
Environment behindAll(double x, const Surface& surface) {
    Environment place = onIce();
    addObstacle(place, "thin wall", {{x, -3}, {x + thinWall, -3}, {x + thinWall, 3}, {x, 3}}, surface);
    return place;
}

struct Deepest {
    double depth = 0;     ///< m, of any two bodies, or a body and the wall
    bool passed = false;  ///< a centre was beyond the wall
    int contacts = 0;
};

Deepest watch(const Scenario& scenario, double wall, int ticks) {
    Deepest result;
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < ticks; ++k) {
        step(scenario, state, buffers, {}, &trace);
        result.depth = std::max(result.depth, -leastGap(scenario, state));
        for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body)
            result.passed = result.passed || Scenario::poseOf(state, body).x > wall;
        result.contacts += static_cast<int>(trace.contacts.size());
    }
    return result;
}

/// A heavy ball hits a light one that rests before a thin wall: sent at nearly twice the speed, it would be far behind
/// it within the tick.
TEST(ChainOfHits, LightBallIsNotSentThroughAThinWall) {
    for (const double speed : {3.0, 6.0, 12.0})
        for (const double before : {0.0, 0.001, 0.03, 0.1})
            for (const double apart : {0.001, 0.04, 0.1})
                for (const double restitution : {0.0, 0.6, 1.0}) {
                    const Surface surface{0.2, restitution};
                    SmallWorld world(behindAll(discRadius + before, surface));
                    world.object(rollingBody(discRadius, 0.05, surface), {0, 0.003, 0});
                    world.object(rollingBody(discRadius, 20, surface), {-2 * discRadius - apart, 0, 0}, {speed, 0, 0});
                    const Deepest seen = watch(world.scenario(), discRadius + before, 15);
                    SCOPED_TRACE(testing::Message() << speed << " m/s, " << before << " before the wall, " << apart
                                                    << " apart, restitution " << restitution);
                    EXPECT_GE(seen.contacts, 2);
                    EXPECT_FALSE(seen.passed);
                    EXPECT_LE(seen.depth, mayEnter);
                }
}

/// The same with a robot that stands: its planned motion is none.
TEST(ChainOfHits, StandingRobotIsNotSentThroughAThinWall) {
    for (const auto& shape : trickyOutlines())
        for (const double speed : {6.0, 12.0})
            for (const double mass : {1.0, 30.0})
                for (const double before : {0.002, 0.05}) {
                    SmallWorld world(behindAll(shape->reach + before, {0.2, 0.3}));
                    world.robot(robotOf(shape, 5), {0, 0, 0.4}, std::make_shared<const Told>(Command{}), ideal());
                    world.object(rollingBody(discRadius, mass, {0.2, 0.6}), {-0.6, 0.02, 0}, {speed, 0, 0});
                    const Deepest seen = watch(world.scenario(), shape->reach + before, 25);
                    SCOPED_TRACE(testing::Message() << shape->name << ", " << speed << " m/s, " << mass << " kg");
                    EXPECT_GE(seen.contacts, mass > 1 ? 2 : 1);
                    EXPECT_FALSE(seen.passed);
                    EXPECT_LE(seen.depth, mayEnter);
                }
}

/// Newton's cradle: ten balls in a row, in touch, nearly so or a little apart, the last one near a thin wall.
TEST(ChainOfHits, RowOfBallsPassesAFastHitOnAndNothingElse) {
    constexpr int count = 10;
    for (const double speed : {6.0, 12.0})
        for (const double apart : {0.0, 0.0005, 0.01})
            for (const double restitution : {0.0, 0.7, 1.0}) {
                const Surface surface{0.1, restitution};
                const double pitch = 2 * discRadius + apart, wall = count * pitch - discRadius - apart + 0.01;
                SmallWorld world(behindAll(wall, surface));
                for (int i = 0; i < count; ++i) world.object(rollingBody(discRadius, 0.43, surface), {pitch * i, 0, 0});
                world.object(rollingBody(discRadius, 0.43, surface), {-pitch - 0.1, 0, 0}, {speed, 0, 0});
                const Scenario scenario = world.scenario();
                const Deepest seen = watch(scenario, wall, 40);
                SCOPED_TRACE(testing::Message() << speed << " m/s, " << apart << " apart, restitution " << restitution);
                EXPECT_GE(seen.contacts, count);
                EXPECT_FALSE(seen.passed);
                EXPECT_LE(seen.depth, mayEnter);
                WorldState state = scenario.initialState();
                run(scenario, state, 40);
                // In one line they keep their order.
                for (std::size_t i = 0; i + 1 < count; ++i)
                    EXPECT_LT(state.objects[i].pose.x, state.objects[i + 1].pose.x) << i;
                EXPECT_LT(state.objects[count].pose.x, state.objects[0].pose.x);
            }
}

/// Apart and elastic, each of equal balls hands its velocity to the next: in the end the last one has it.
TEST(ChainOfHits, ElasticRowHandsTheVelocityToItsLastBall) {
    constexpr int count = 10;
    SmallWorld world(onIce());
    for (int i = 0; i < count; ++i) world.object(rollingBody(discRadius, 0.43, {0, 1}), {0.221 * i, 0, 0});
    world.object(rollingBody(discRadius, 0.43, {0, 1}), {-0.4, 0, 0}, {12, 0, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, 10);
    for (int i = 0; i < count; ++i)
        EXPECT_NEAR(state.objects[static_cast<std::size_t>(i)].velocity_W.x, i + 1 == count ? 12 : 0, 1e-6) << i;
    EXPECT_NEAR(state.objects[count].velocity_W.x, 0, 1e-6);
    EXPECT_NEAR(state.objects[count - 1].pose.x, 0.221 * 9 + 12 * 0.2 - (0.18 + 0.001 * 9), 0.001);
}

/// Fifteen balls in a triangle, in a box hardly larger, hit at 12 m/s: dozens of touches in one tick.
TEST(ChainOfHits, BreakOfARackStaysInItsBox) {
    for (const double restitution : {0.3, 0.95}) {
        const Surface surface{0.1, restitution};
        SmallWorld world(onIce(walledField(1.9, 1.3, surface)));
        for (int row = 0; row < 5; ++row)
            for (int i = 0; i <= row; ++i)
                world.object(rollingBody(discRadius, 0.43, surface),
                             {0.85 + 0.1906 * row, 0.65 + 0.2202 * (i - 0.5 * row), 0});
        world.object(rollingBody(discRadius, 0.43, surface), {0.3, 0.653, 0}, {12, 0, 0});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        std::size_t most = 0;
        for (int k = 0; k < 150; ++k) {
            step(scenario, state, buffers, {}, &trace);
            most = std::max(most, trace.contacts.size());
            ASSERT_GE(leastGap(scenario, state), -mayEnter) << "tick " << k << ", restitution " << restitution;
            for (const ObjectState& ball : state.objects)
                ASSERT_TRUE(ball.pose.x > 0 && ball.pose.x < 1.9 && ball.pose.y > 0 && ball.pose.y < 1.3);
        }
        EXPECT_GT(most, 12u);
    }
}

/// A fast ball in a wedge and in a slot hardly wider than itself: many touches with two walls in one tick.
TEST(ChainOfHits, FastBallRattlesInAWedgeWithoutEnteringIt) {
    for (const double half : {0.03, 0.1, 0.4})  // rad
        for (const double aside : {0.0, 0.01, -0.02})
            for (const double speed : {6.0, 12.0}) {
                Environment place = onIce();
                const double c = std::cos(half), s = std::sin(half), l = 8;
                addObstacle(place, "upper", {{0, 0}, {l * c, l * s}, {l * c - 0.05 * s, l * s + 0.05 * c}}, {0, 0.95});
                addObstacle(place, "lower", {{0, 0}, {l * c + 0.05 * s, -l * s - 0.05 * c}, {l * c, -l * s}},
                            {0, 0.95});
                SmallWorld world(place);
                const double there = discRadius / s;  // where the ball fits just so
                world.object(rollingBody(discRadius, 0.43, {0, 0.95}), {there + 0.5, aside * 0.5, 0}, {-speed, 0, 0});
                const Scenario scenario = world.scenario();
                WorldState state = scenario.initialState();
                StepBuffers buffers;
                StepTrace trace;
                std::size_t contacts = 0;
                for (int k = 0; k < 40; ++k) {
                    step(scenario, state, buffers, {}, &trace);
                    contacts += trace.contacts.size();
                    ASSERT_GE(gapToObstacles(scenario, state, 0), -mayEnter) << half << ' ' << speed << ", tick " << k;
                    ASSERT_GE(state.objects[0].pose.x, there - mayEnter / s) << half << ' ' << speed;
                }
                EXPECT_GT(contacts, 0u);
            }
}

/// Eight robots all round press a light ball from all sides.
TEST(ChainOfHits, CrowdThatPressesALightBallDoesNotEnterIt) {
    for (const double speed : {0.3, 1.0})
        for (const double mass : {0.05, 0.43}) {
            SmallWorld world;
            for (int i = 0; i < 8; ++i) {
                const double angle = 2 * pi * i / 8 + 0.1, away = i % 2 == 0 ? 0.6 : 1.0;
                const auto shape = i % 2 == 0 ? squareRobot(0.3).shape : hornedOutline();
                world.robot(robotOf(shape, 15), {away * std::cos(angle), away * std::sin(angle), angle + pi},
                            std::make_shared<const Told>(Command{speed, 0}), ideal(), i % 5);
            }
            world.object(rollingBody(discRadius, mass, {0.2, 0.6}), {0, 0, 0});
            const Scenario scenario = world.scenario();
            WorldState state = scenario.initialState();
            StepBuffers buffers;
            StepTrace trace;
            double ball = 0, robots = 0;
            int touched = 0;
            for (int k = 0; k < 250; ++k) {
                step(scenario, state, buffers, {}, &trace);
                touched += trace.touchedObjects[0] ? 1 : 0;
                ball = std::max(ball, -leastGap(scenario, state, 8));
                robots = std::max(robots, -leastGap(scenario, state));
            }
            SCOPED_TRACE(testing::Message() << speed << " m/s, " << mass << " kg");
            EXPECT_GT(touched, 100);
            EXPECT_LE(ball, mayEnter);
            EXPECT_LE(robots, 0.002);
        }
}

}  // namespace
}  // namespace mrose
