#include "sensing/laser.h"

#include <gtest/gtest.h>

#include "sensing/ranging.h"

namespace mrose {
namespace {

using std::numbers::pi;
constexpr double noReturn = std::numeric_limits<double>::infinity();

Laser::Options fanOf(std::size_t beams, double first, double last, double range = 8) {
    Laser::Options options;
    options.beams = beams;
    options.first = first;
    if (beams > 1) options.step = (last - first) / static_cast<double>(beams - 1);
    options.errors.range = range;
    return options;
}

std::shared_ptr<const Laser> laser(const Laser::Options& options, Nanoseconds period = 0) {
    return std::make_shared<const Laser>(SensorTraits{"laser", period}, options);
}

std::vector<RangeEcho> scanOf(const SmallWorld& world) {
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    return recordsNow<RangeEcho>(scenario, state, "laser");
}

TEST(Laser, BeamsMeetAWallWhereTheClosedFormSays) {
    const auto echoes = scanOf(sensing(laser(fanOf(181, -pi / 2, pi / 2)), wallAhead(3)));
    ASSERT_EQ(echoes.size(), 181u);
    for (const RangeEcho& echo : echoes) {
        const double expected = 3 / std::cos(echo.bearing);
        if (std::abs(echo.bearing) < std::acos(3 / 8.0) - 1e-6)
            EXPECT_NEAR(echo.range, expected, 1e-12 * expected) << echo.bearing;
        else
            EXPECT_EQ(echo.range, noReturn) << echo.bearing;
    }
    EXPECT_NEAR(echoes[0].bearing, -pi / 2, 1e-15);
    EXPECT_NEAR(echoes[90].bearing, 0, 1e-15);
    EXPECT_NEAR(echoes[180].bearing, pi / 2, 1e-15);
}

TEST(Laser, BeamsMeetACircleWhereTheClosedFormSays) {
    const auto echoes =
        scanOf(sensing(laser(fanOf(721, -pi, pi))).robot(discRobot(0.3), {-1, 2, 0.4}, still(), ideal()));
    const double away = std::sqrt(5.0), bearing = std::atan2(2, -1);
    int hits = 0;
    for (const RangeEcho& echo : echoes) {
        const double aside = away * std::sin(echo.bearing - bearing), along = away * std::cos(echo.bearing - bearing);
        if (along > 0 && std::abs(aside) < 0.3) {
            EXPECT_NEAR(echo.range, along - std::sqrt(0.09 - aside * aside), 1e-9) << echo.bearing;
            ++hits;
        } else {
            EXPECT_EQ(echo.range, noReturn) << echo.bearing;
        }
    }
    EXPECT_NEAR(hits, 2 * std::asin(0.3 / away) * 180 / pi * 2, 2);
}

/// Of fans of every width, mounts off the middle, and in places with few obstacles and with many.
TEST(Laser, RangesAreThoseOfSolvingForEachOutline) {
    int met = 0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const double width = 0.1 + 2 * pi * uniformNoise({seed, 1, 0, 0});
        const double first = 2 * pi * uniformNoise({seed, 1, 0, 1}) - pi;
        Laser::Options options = fanOf(1 + seed * 7, first, first + std::min(width, 2 * pi), 5);
        options.mount = {0.1, -0.05, 0.3 * seed};
        const Scenario scenario = randomScene(laser(options), seed, seed % 3 == 0 ? 60 : 12, seed % 3 == 0 ? 12 : 7);
        WorldState state = scenario.initialState();
        const Pose mount = state.robots[0].pose * options.mount;
        const auto echoes = recordsNow<RangeEcho>(scenario, state, "laser");
        ASSERT_EQ(echoes.size(), options.beams);
        for (std::size_t beam = 0; beam < echoes.size(); ++beam) {
            const double direction = mount.heading + options.first + static_cast<double>(beam) * options.step;
            double expected = solvedRay(scenario, state, 0, position(mount), towards(direction)).range;
            if (expected > 5) expected = noReturn;
            if (std::isinf(expected))
                ASSERT_EQ(echoes[beam].range, expected) << seed << ' ' << beam;
            else
                ASSERT_NEAR(echoes[beam].range, expected, 1e-9) << seed << ' ' << beam;
            met += std::isfinite(expected) ? 1 : 0;
        }
    }
    EXPECT_GT(met, 5000);
}

/// Also where the environment has so many obstacles that they lie in a grid.
TEST(Laser, ManyObstaclesAreMetAsFewAre) {
    Environment forest;
    for (int i = 0; i < 400; ++i) {
        ShapePart part;
        part.radius = 0.05 + 0.1 * uniformNoise({3, 0, 0, static_cast<std::uint32_t>(i)});
        part.centre = {1.5 * (i % 20) + 0.7, 1.5 * (i / 20) + 0.4};
        forest.obstacles.push_back({"tree", Shape::fromParts("tree", {part}), {}});
    }
    ShapePart fence;
    fence.polygon = {{-1, 14}, {31, 14.1}, {31, 14.2}, {-1, 14.1}};
    forest.obstacles.push_back({"fence", Shape::fromParts("fence", {fence}), {}});
    for (const Pose& start : {Pose{15.3, 13, 0.2}, Pose{-4, -4, 0.7}, Pose{15.3, 40, -1.6}}) {
        const Scenario scenario = sensing(laser(fanOf(360, -pi, pi * 179 / 180, 12)), forest, start).scenario();
        WorldState state = scenario.initialState();
        for (const RangeEcho& echo : recordsNow<RangeEcho>(scenario, state, "laser")) {
            const double expected =
                solvedRay(scenario, state, 0, position(start), towards(start.heading + echo.bearing)).range;
            if (expected > 12)
                ASSERT_EQ(echo.range, noReturn);
            else
                ASSERT_NEAR(echo.range, expected, 1e-9);
        }
    }
}

TEST(Laser, WhatItIsInsideOfIsNotMet) {
    const auto echoes = scanOf(sensing(laser(fanOf(4, 0, 1.5 * pi)), wallAhead(-0.1, 0.3)));
    for (const RangeEcho& echo : echoes) EXPECT_EQ(echo.range, noReturn);
}

TEST(Laser, NoiseHasItsSpreadAndGrowsWithRange) {
    Laser::Options options = fanOf(64, -0.3, 0.3);
    options.errors.noise = 0.02;
    options.errors.noiseShare = 0.01;
    const Scenario scenario = sensing(laser(options), wallAhead(3)).scenario();
    SensorWatch watch(scenario, 7);
    StandardNormals normals, neighbours;
    for (int i = 0; i < 200; ++i) {
        const auto echoes = watch.next().records<RangeEcho>("laser");
        double before = 0;
        for (const RangeEcho& echo : echoes) {
            const double range = 3 / std::cos(echo.bearing), z = (echo.range - range) / (0.02 + 0.01 * range);
            normals.add(z);
            if (&echo != &echoes[0]) neighbours.add((z + before) / std::sqrt(2.0));
            before = z;
        }
    }
    normals.expectStandard("each beam");
    // Sums of neighbours share a beam with the next: their squares spread by 3/2 as much.
    EXPECT_NEAR(neighbours.squares / neighbours.count, 1, sigmas * std::sqrt(3.0 / neighbours.count));
}

TEST(Laser, DropsOutRoundsAndHasLimits) {
    Laser::Options options = fanOf(101, -0.5, 0.5);
    options.errors.dropOut = 0.1;
    options.errors.resolution = 0.01;
    options.errors.leastRange = 1.05;
    options.errors.range = 1.1;
    const Scenario scenario = sensing(laser(options), wallAhead(1)).scenario();
    SensorWatch watch(scenario, 3);
    int dropped = 0, within = 0;
    for (int i = 0; i < 300; ++i)
        for (const RangeEcho& echo : watch.next().records<RangeEcho>("laser")) {
            const double range = 1 / std::cos(echo.bearing);
            if (range < 1.05 || range > 1.1) {
                EXPECT_EQ(echo.range, noReturn);
                continue;
            }
            ++within;
            if (std::isinf(echo.range))
                ++dropped;
            else
                EXPECT_NEAR(echo.range, std::round(range * 100) / 100, 1e-9);
        }
    expectRate(dropped, within, 0.1);
}

/// 35 ms are no whole number of ticks: it is measured between two.
TEST(Laser, LateScansAreThoseOfTheirInstant) {
    constexpr Nanoseconds ms = 1'000'000;
    Laser::Options late = fanOf(30, -1, 1);
    late.latency = 35 * ms;
    const auto world = [&](const Laser::Options& options) {
        RobotType type = discRobot(0.2);
        type.sensors = {laser(options, 50 * ms)};
        return SmallWorld(walledField(6, 6))
            .robot(type, {1, 3, 0}, std::make_shared<const Told>(Command{0.3, 0.5}),
                   std::make_shared<const KinematicModel>(KinematicParameters{}, 100 * ms))
            .robot(discRobot(0.2), {4, 3, 1}, std::make_shared<const Told>(Command{-0.2, 0}), ideal())
            .scenario();
    };
    const Scenario scenario = world(late);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    std::vector<WorldState> states;
    int scans = 0;
    for (int k = 0; k < 200; ++k) {
        states.push_back(state);
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].observed) continue;
        for (const Reading& reading : trace.robots[0].observation.readings()) {
            if (reading.name != ReadingName("laser") || reading.measured < 0) continue;
            ASSERT_EQ(reading.measured % (50 * ms), 0);
            ASSERT_GE(trace.robots[0].observation.time - reading.measured, 35 * ms);
            // Bodies evenly between the two ticks.
            const auto before = static_cast<std::size_t>(reading.measured / (20 * ms));
            const double share = static_cast<double>(reading.measured % (20 * ms)) / (20.0 * ms);
            WorldState then = states[before];
            if (share > 0)
                for (std::size_t i = 0; i < 2; ++i) {
                    const Pose a = states[before].robots[i].pose, b = states[before + 1].robots[i].pose;
                    then.robots[i].pose = {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
                                           a.heading + share * (b.heading - a.heading)};
                }
            ++scans;
            for (const RangeEcho& echo : trace.robots[0].observation.records<RangeEcho>(&reading)) {
                const Pose& eye = then.robots[0].pose;
                EXPECT_NEAR(echo.range,
                            solvedRay(scenario, then, 0, position(eye), towards(eye.heading + echo.bearing)).range,
                            1e-9);
            }
        }
    }
    EXPECT_GE(scans, 70);
}

TEST(Laser, RepeatsItsReadingsFromEveryTick) {
    constexpr Nanoseconds ms = 1'000'000;
    Laser::Options options = fanOf(40, -1.5, 1.5);
    options.errors.noise = 0.02;
    options.errors.dropOut = 0.05;
    options.latency = 50 * ms;
    const Scenario scenario = randomScene(laser(options, 30 * ms), 5, 8, 6);
    expectSameFromEveryTick(scenario, 60);
}

TEST(Laser, SummaryHasTheNearestEcho) {
    const auto sensor = laser(fanOf(5, -1, 1));
    const Scenario scenario = sensing(sensor, wallAhead(2)).scenario();
    WorldState state = scenario.initialState();
    Observation out;
    perceive(scenario, state, 0, out);
    const auto entries = sensor->summary(out, *out.find("laser"));
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_EQ(entries[0].name, "nearest");
    EXPECT_NEAR(entries[0].value, 2, 1e-12);
    EXPECT_NEAR(entries[1].value, 0, 1e-12);
    EXPECT_EQ(entries[2].value, 5);
    EXPECT_EQ(sensor->elements().size(), 5u);
    EXPECT_NEAR(sensor->elements()[4].mount.heading, 1, 1e-12);
}

}  // namespace
}  // namespace mrose
