// Fast balls and robots enter nothing that is solid: true shapes, at the end of every tick.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/small_world.h"
#include "support/contact_measures.h"
#include "support/outlines.h"
#include "support/scenes.h"
#include "support/shipped.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr double ballRadius = 0.11, fullSpeed = 6;  // m, m/s
constexpr double ballMayEnter = 0.001, robotMayEnter = 0.002;

/// Whether the straight way of a point from tick to tick passes through a shape, as seen from it.
bool crosses(const Shape& shape, const Point& before_B, const Point& after_B) {
    if (std::min(length(before_B), length(after_B)) > shape.reach + 0.3) return false;
    for (int i = 0; i <= 20; ++i)
        if (depthOfPoint(shape, before_B + 0.05 * i * (after_B - before_B)) > 0) return true;
    return false;
}

struct Throws {
    int hits = 0;
    double deepest = 0;  ///< m
    int through = 0;     ///< ticks in which the ball's centre went through the body
};

/// Throws a ball at body 0 of a scenario of its own from all round, most at full speed; robots drive by `driven`.
void throwAt(const std::shared_ptr<const Shape>& shape, const Command& driven, std::int64_t trial, Throws& result) {
    const auto draw = [&](std::uint32_t c) { return 2 * uniformNoise({31, trial, 0, c}) - 1; };
    const double from = pi * draw(0), aside = (shape->reach + 0.05) * draw(1);
    const double speed = trial % 3 == 0 ? 3.5 + 2.5 * draw(2) : fullSpeed;
    const Point direction{std::cos(from), std::sin(from)};
    const Point start = -(shape->reach + 0.25 + 0.1 * draw(3)) * direction + aside * Point{-direction.y, direction.x};
    SmallWorld world(onIce());
    world.robot(robotOf(shape), {0, 0, 0}, std::make_shared<const Told>(driven), ideal());
    world.object(ballType(), {start.x, start.y, 0}, {speed * direction.x, speed * direction.y, 20 * draw(4)});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    bool touched = false;
    for (int k = 0; k < 12; ++k) {
        const auto seen = [&] { return Placement(state.robots[0].pose).placeBack(position(state.objects[0].pose)); };
        const Point before = seen();
        step(scenario, state, buffers, {}, &trace);
        touched = touched || !trace.contacts.empty();
        result.deepest = std::max(result.deepest, -gapBetween(scenario, state, 0, 1));
        result.through += crosses(*shape, before, seen()) ? 1 : 0;
    }
    result.hits += touched ? 1 : 0;
}

TEST(NoEntry, BallThrownAtAStandingOrDrivingRobotStaysOutside) {
    for (const char* name : {"pioneer1", "husky"}) {
        const auto shape = shippedRobot(name).type.shape;
        Throws result;
        for (std::int64_t trial = 0; trial < 2000; ++trial) {
            const auto draw = [&](std::uint32_t c) { return 2 * uniformNoise({32, trial, 0, c}) - 1; };
            throwAt(shape, trial % 2 == 0 ? Command{} : Command{draw(0), 3 * draw(1)}, trial, result);
        }
        EXPECT_LE(result.deepest, ballMayEnter) << name;
        EXPECT_EQ(result.through, 0) << name;
        EXPECT_GT(result.hits, 1400) << name;
    }
}

TEST(NoEntry, BallThrownAtHornsStaysOutside) {
    Throws result;
    for (std::int64_t trial = 0; trial < 1000; ++trial) throwAt(hornedOutline(), {}, trial, result);
    for (std::int64_t trial = 0; trial < 1000; ++trial) throwAt(hornedOutline(), {0.5, 2}, trial, result);
    for (const auto& shape : trickyOutlines())
        for (std::int64_t trial = 0; trial < 100; ++trial) throwAt(shape, {}, trial, result);
    EXPECT_LE(result.deepest, ballMayEnter);
    EXPECT_EQ(result.through, 0);
    EXPECT_GT(result.hits, 1500);
}

/// At the corners and posts of the shipped field's goals, from within the field.
TEST(NoEntry, BallThrownAtCornersOfGoalsStaysInTheField) {
    const Environment field = shippedEnvironment("midsize_2001");
    double deepest = 0;
    int hits = 0;
    for (std::int64_t trial = 0; trial < 2000; ++trial) {
        const auto draw = [&](std::uint32_t c) { return 2 * uniformNoise({33, trial, 0, c}) - 1; };
        const double side = trial % 2 == 0 ? 1 : -1, end = trial % 4 < 2 ? 1 : -1;
        // At the post, at the corner within the goal, at the cut corner of the field.
        const Point targets[] = {{4.5, 1}, {5, 1}, {4.4, 2.4}};
        const Point target = targets[trial % 3];
        const double angle = 0.5 * pi * draw(0);
        const Point from = (trial % 3 == 1 ? Point{4.75, 0.7} : target) +
                           Point{-0.5 * std::cos(angle) * (trial % 3 == 1 ? 0.2 : 1), -0.4 - 0.1 * std::sin(angle)};
        const Point way = target + Point{0.12 * draw(1), 0.12 * draw(2)} - from;
        const Point velocity = fullSpeed / length(way) * way;
        SmallWorld world(field);
        world.parts().kickOff = false;
        world.object(ballType(), {end * from.x, side * from.y, 0}, {end * velocity.x, side * velocity.y, 20 * draw(3)});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        for (int k = 0; k < 15; ++k) {
            step(scenario, state, buffers, {}, &trace);
            hits += trace.contacts.empty() ? 0 : 1;
            deepest = std::max(deepest, -gapToObstacles(scenario, state, 0));
            ASSERT_TRUE(contains(field.floor.area, position(state.objects[0].pose))) << trial << ", tick " << k;
        }
    }
    EXPECT_LE(deepest, ballMayEnter);
    EXPECT_GT(hits, 2000);
}

/// A thin needle that stands still, alone: no bounce leads to its other side.
TEST(NoEntry, BallThrownAtANeedleStaysOutside) {
    Environment place = onIce();
    addObstacle(place, "needle", needle(0.3, 0.01), {0.2, 0.3});
    const auto shape = outlineOf("needle", {needle(0.3, 0.01)});
    double deepest = 0;
    int hits = 0, through = 0;
    for (std::int64_t trial = 0; trial < 3000; ++trial) {
        const auto draw = [&](std::uint32_t c) { return 2 * uniformNoise({34, trial, 0, c}) - 1; };
        const double from = pi * draw(0);
        const Point direction{std::cos(from), std::sin(from)};
        const Point target{trial % 2 == 0 ? 0 : -0.15 + 0.15 * draw(1), 0};
        const Point start =
            target - (0.3 + 0.1 * draw(2)) * direction + 0.11 * draw(3) * Point{-direction.y, direction.x};
        SmallWorld world(place);
        world.object(ballType(), {start.x, start.y, 0},
                     {fullSpeed * direction.x, fullSpeed * direction.y, 20 * draw(4)});
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        if (gapToObstacles(scenario, state, 0) < 0) continue;
        bool touched = false;
        for (int k = 0; k < 8; ++k) {
            const Point before = position(state.objects[0].pose);
            step(scenario, state, buffers, {}, &trace);
            touched = touched || !trace.contacts.empty();
            deepest = std::max(deepest, -gapToObstacles(scenario, state, 0));
            through += crosses(*shape, before, position(state.objects[0].pose)) ? 1 : 0;
        }
        hits += touched ? 1 : 0;
    }
    EXPECT_LE(deepest, ballMayEnter);
    EXPECT_EQ(through, 0);
    EXPECT_GT(hits, 2000);
}

/// Robots that drive at 3 m/s into others that do, and go on pressing.
TEST(NoEntry, RobotsAtFullSpeedStayOutOfEachOther) {
    std::vector<std::shared_ptr<const Shape>> shapes = trickyOutlines();
    for (const char* name : {"pioneer1", "nomad200", "husky"}) shapes.push_back(shippedRobot(name).type.shape);
    double deepest = 0;
    int hits = 0;
    for (std::int64_t trial = 0; trial < 250; ++trial) {
        const auto draw = [&](std::uint32_t c) { return uniformNoise({35, trial, 0, c}); };
        const auto any = [&](std::uint32_t c) {
            return shapes[static_cast<std::size_t>(draw(c) * static_cast<double>(shapes.size()))];
        };
        SmallWorld world;
        const double turn = 2 * draw(2) - 1;
        world.robot(robotOf(any(0), 5 + 40 * draw(3)), {-1.1, 0.4 * (draw(4) - 0.5), 0.3 * (draw(5) - 0.5)},
                    std::make_shared<const Told>(Command{3, turn}), ideal());
        world.robot(robotOf(any(1), 5 + 40 * draw(6)), {1.1, 0, pi + 0.3 * (draw(7) - 0.5)},
                    std::make_shared<const Told>(Command{3, -turn}), ideal());
        const Scenario scenario = world.scenario();
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        bool touched = false;
        for (int k = 0; k < 60; ++k) {
            step(scenario, state, buffers, {}, &trace);
            touched = touched || !trace.contacts.empty();
            deepest = std::max(deepest, -gapBetween(scenario, state, 0, 1));
        }
        hits += touched ? 1 : 0;
    }
    EXPECT_LE(deepest, robotMayEnter);
    EXPECT_GT(hits, 200);
}

/// 120 times as heavy as what they push together.
TEST(NoEntry, LightBoxesThatHeavyRobotsHeapUp) {
    SmallWorld world(walledField(6, 6));
    for (int i = 0; i < 4; ++i)
        world.robot(squareRobot(0.45, 60), {1.1 + 0.55 * i, 2.9 - 0.55 * i, pi * 5 / 4},
                    std::make_shared<const Told>(Command{0.5, 0}), ideal());
    for (int i = 0; i < 24; ++i) world.object(boxType(0.3, 0.5), {0.25 + 0.32 * (i % 5), 0.25 + 0.32 * (i / 5), 0}, {});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    double deepest = 0;
    std::size_t most = 0;
    for (int k = 0; k < 400; ++k) {
        step(scenario, state, buffers, {}, &trace);
        most = std::max(most, trace.contacts.size());
        deepest = std::max(deepest, -leastGap(scenario, state));
    }
    EXPECT_LE(deepest, 0.003);
    EXPECT_GT(most, 24U);
}

}  // namespace
}  // namespace mrose
