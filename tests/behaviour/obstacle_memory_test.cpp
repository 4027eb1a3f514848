#include "behaviour/obstacle_memory.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "control/sensor_records.h"
#include "support/units.h"

namespace mrose {
namespace {

using Kind = ObstacleSensor::Kind;
constexpr double silent = std::numeric_limits<double>::infinity();

/// One of five beams over the half-plane ahead, one of four sonars all round, four infrared elements, bumpers.
std::vector<ObstacleSensor> allKinds() {
    std::vector<Pose> beams, ring;
    for (int i = -2; i <= 2; ++i) beams.push_back({0, 0, i * pi / 4});
    for (int i = 0; i < 4; ++i) ring.push_back({0, 0, i * pi / 2});
    return {{Kind::laser, "laser", beams, 0, 8},
            {Kind::sonar, "sonar", ring, 0.25, 5},
            {Kind::infrared, "infrared", ring, 0.1, 0.8, 0.1, 0.02, 0.01},
            {Kind::bumpers, "bumpers", ring, pi / 4, 0.3}};
}

/// A robot that is given readings.
struct Robot {
    std::vector<ObstacleSensor> sensors = allKinds();
    ObstacleMemory memory{};
    MotionMemory motion{};
    Velocity velocity{};
    Nanoseconds now = 0, latency = 0;
    ObstacleMemory::Options options{4, second};

    template <class Record>
    void sense(const ReadingName& name, const std::vector<Record>& records) {
        Observation observation;
        observation.time = now;
        observation.add(odometryReading, now, velocity);
        if (!records.empty()) observation.add(name, now - latency, std::span<const Record>(records));
        motion.observe(observation);
        memory.update(observation, motion, sensors, options);
        motion.issue({});
    }
    void ranges(const ReadingName& name, const std::vector<double>& values) {
        std::vector<RangeEcho> echoes;
        for (const double range : values) echoes.push_back({0, range});
        sense(name, echoes);
    }
    void wait(Nanoseconds time) {
        now += time;
        sense<RangeEcho>("laser", {});
    }
    /// Whether there is a point near a place of the frame in which it started.
    bool has(const Point& place, double within = 1e-5) const {
        for (const ObstacleMemory::Found& found : memory.found())
            if (distance(place, {found.x, found.y}) < within) return true;
        return false;
    }
};

TEST(ObstacleMemory, EchoesAreWhereTheBeamsMetSomething) {
    Robot robot;
    robot.ranges("laser", {1, silent, 2, 3, 3.5});
    EXPECT_EQ(robot.memory.count, 4u);
    EXPECT_TRUE(robot.has({0, -1}));
    EXPECT_TRUE(robot.has({2, 0}));
    EXPECT_TRUE(robot.has({3 * std::sqrt(0.5), 3 * std::sqrt(0.5)}));
    EXPECT_TRUE(robot.has({0, 3.5}));
    robot.ranges("laser", {4.5, 5, 6, 7, 7});
    EXPECT_EQ(robot.memory.count, 0u) << "beyond its reach";
}

TEST(ObstacleMemory, NewestScanIsAllThereIsWhereItLooks) {
    Robot robot;
    robot.ranges("laser", {1, 1, 1, 1, 1});
    robot.now += 100 * ms;
    robot.ranges("laser", {silent, 2, silent, silent, silent});
    EXPECT_EQ(robot.memory.count, 1u);
    EXPECT_TRUE(robot.has({2 * std::sqrt(0.5), -2 * std::sqrt(0.5)}));
}

/// What it saw at its right stays where it was when it has turned and driven on, and looks elsewhere, for a second.
TEST(ObstacleMemory, PointsOutOfViewStayWhereTheyWereForASecond) {
    Robot robot;
    robot.velocity = {0.3, 1};
    robot.ranges("laser", {1, silent, silent, silent, silent});
    for (int i = 1; i <= 10; ++i) {
        robot.wait(100 * ms);
        if (i == 5 || i == 10) robot.ranges("laser", {silent, silent, silent, silent, silent});
        EXPECT_TRUE(robot.has({0, -1})) << i;
    }
    const Pose expected = exp({0.3, 0, 1});
    EXPECT_NEAR(robot.memory.odometry.x, expected.x, 1e-12);
    EXPECT_NEAR(robot.memory.odometry.y, expected.y, 1e-12);
    EXPECT_NEAR(robot.memory.odometry.heading, expected.heading, 1e-12);
    robot.wait(100 * ms);
    EXPECT_EQ(robot.memory.count, 0u);
}

/// A scan that arrives late is of where the robot was.
TEST(ObstacleMemory, LateReadingsAreOfWhereTheRobotWas) {
    Robot robot;
    robot.velocity = {1, 0};
    for (int i = 0; i <= 5; ++i) {
        robot.now = i * 100 * ms;
        if (i < 5) robot.wait(0);
    }
    robot.latency = 200 * ms;
    robot.ranges("laser", {silent, silent, 2, silent, silent});
    EXPECT_TRUE(robot.has({2.3, 0}));
}

TEST(ObstacleMemory, SonarsEchoRefutesWhatItLooksThroughAndItsSilenceNothing) {
    Robot robot;
    robot.ranges("sonar", {1, silent, 2, silent});
    EXPECT_TRUE(robot.has({1, 0}));
    EXPECT_TRUE(robot.has({-2, 0}));
    EXPECT_EQ(robot.memory.count, 2u);
    robot.now = 200 * ms;
    robot.ranges("sonar", {3, silent, silent, silent});
    EXPECT_FALSE(robot.has({1, 0}));
    EXPECT_TRUE(robot.has({3, 0}));
    EXPECT_TRUE(robot.has({-2, 0}));
    robot.now = 400 * ms;
    robot.ranges("sonar", {1, silent, silent, silent});
    EXPECT_TRUE(robot.has({3, 0})) << "it hides behind the new one";
}

TEST(ObstacleMemory, EchoThatAnotherSensorsPointExplainsAddsNone) {
    Robot robot;
    robot.ranges("laser", {silent, silent, 1.05, silent, silent});
    robot.ranges("sonar", {1, silent, 1, silent});
    EXPECT_EQ(robot.memory.count, 2u);
    EXPECT_TRUE(robot.has({-1, 0}));
    EXPECT_FALSE(robot.has({1, 0}));
}

TEST(ObstacleMemory, InfraredIsAsFarAwayAsItsIntensitySays) {
    Robot robot;
    std::vector<InfraredEcho> echoes;
    for (const double range : {0.4, 0.2, 1e9, 0.95}) echoes.push_back({0, std::pow(0.1 / range, 2) + 0.02});
    echoes[3].intensity = 0.02 + 0.009;
    robot.sense("infrared", echoes);
    EXPECT_TRUE(robot.has({0.4, 0}));
    EXPECT_TRUE(robot.has({0, 0.2}));
    EXPECT_EQ(robot.memory.count, 2u);
}

TEST(ObstacleMemory, BumpsAreOnTheOutlineForThreeSeconds) {
    Robot robot;
    robot.sense<BumperContact>("bumpers", {{0, 0, 0}, {pi / 2, 1, 1}, {pi, 0, 4}, {-pi / 2, 0, 0}});
    EXPECT_EQ(robot.memory.count, 1u);
    EXPECT_TRUE(robot.has({0, 0.3}));
    robot.wait(3 * second);
    EXPECT_TRUE(robot.has({0, 0.3}));
    robot.wait(1 * ms);
    EXPECT_EQ(robot.memory.count, 0u);
}

/// A person's width at 1 m/s, before a wall: the points of it have its velocity, those of the wall none.
TEST(ObstacleMemory, WhatMovesBeforeALaserHasAVelocity) {
    Robot robot;
    robot.sensors = {{Kind::laser, "laser", {}, 0, 8}};
    for (int i = 0; i <= 180; ++i) robot.sensors[0].elements.push_back({0, 0, (i - 90) * degree});
    for (int scan = 0; scan < 15; ++scan, robot.now += 100 * ms) {
        const double middle = -0.7 + 0.1 * scan;
        std::vector<double> ranges;
        for (int i = 0; i <= 180; ++i) {
            const double along = std::cos((i - 90) * degree), aside = std::sin((i - 90) * degree);
            const bool meets = along > 0.1 && std::abs(2 * aside / along - middle) < 0.24;
            ranges.push_back(meets ? 2 / along : along > 0.1 ? 3 / along : silent);
        }
        robot.ranges("laser", ranges);
    }
    int moving = 0, still = 0;
    for (const ObstacleMemory::Found& found : robot.memory.found()) {
        const bool person = found.x < 2.5;
        (person ? moving : still) += 1;
        EXPECT_NEAR(found.vx, 0, person ? 0.1 : 0);
        EXPECT_NEAR(found.vy, person ? 1 : 0, person ? 0.15 : 0);
    }
    EXPECT_GT(moving, 3);
    EXPECT_GT(still, 10);
}

TEST(ObstacleMemory, NeverHoldsMoreThanItHasRoomFor) {
    Robot robot;
    robot.options = {8, 60 * second};
    for (int i = 0; i < 400; ++i) {
        robot.velocity = {0, 0.5};
        robot.now += 100 * ms;
        robot.ranges("sonar", {1 + 0.05 * (i % 60), silent, 2 + 0.03 * (i % 60), silent});
        ASSERT_LE(robot.memory.count, ObstacleMemory::capacity);
    }
    const Pose& at = robot.memory.odometry;
    EXPECT_TRUE(robot.has(Placement(at).place({1 + 0.05 * 39, 0}), 1e-4)) << "the newest has room";
}

}  // namespace
}  // namespace mrose
