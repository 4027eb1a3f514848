#include "sensing/body_sight.h"

#include "sensing/perceiving.h"
#include "support/units.h"

namespace mrose {
namespace {

const Pose start{2, 1, 2.5};

/// One robot and balls at polar places about it: range, bearing.
Scenario ballsAround(const BodySight& sight, const std::vector<std::pair<double, double>>& places) {
    SmallWorld world;
    world.robot(seeing(sight), start, still(), ideal());
    for (const auto& [range, bearing] : places)
        world.object(ballType(), start * Pose{range * std::cos(bearing), range * std::sin(bearing), 0});
    return world.scenario();
}

std::vector<std::uint32_t> indices(std::span<const SeenBody> bodies) {
    std::vector<std::uint32_t> result;
    for (const SeenBody& body : bodies) result.push_back(body.index);
    return result;
}

TEST(BodySight, RangeNoiseGrowsWithRangeAndBearingNoiseDoesNot) {
    const BodySight sight{.bearingNoise = 0.02, .rangeNoise = 0.03, .rangeNoiseSlope = 0.02};
    for (const double range : {0.5, 4.0}) {
        const Scenario scenario = ballsAround(sight, {{range, 0.7}, {range, -0.2}});
        SensorWatch watch(scenario, 21);
        StandardNormals ranges, bearings, rangeAndBearing, bothBearings;
        for (int i = 0; i < 20000; ++i) {
            const std::span<const SeenBody> seen = watch.next().objects();
            ASSERT_EQ(seen.size(), 2u);
            const auto bearingOf = [](const Point& p) { return std::atan2(p.y, p.x); };
            const double zr = (length(seen[0].position_B) / range - 1) / (0.03 + 0.02 * range);
            const double zb = (bearingOf(seen[0].position_B) - 0.7) / 0.02;
            ranges.add(zr);
            bearings.add(zb);
            rangeAndBearing.add((zr + zb) / std::sqrt(2));
            bothBearings.add((zb + (bearingOf(seen[1].position_B) + 0.2) / 0.02) / std::sqrt(2));
        }
        ranges.expectStandard("range");
        bearings.expectStandard("bearing");
        rangeAndBearing.expectStandard("range and bearing");
        bothBearings.expectStandard("bearings of two bodies");
    }
}

TEST(BodySight, BearingBiasDriftsAndIsCommonToAllBodies) {
    Perception perception;
    perception.self.biasTime = 2;
    perception.objects.bearingBias = 0.04;
    perception.robots.bearingBias = 0.02;
    const Scenario scenario = SmallWorld()
                                  .robot(perceiving(perception), {}, still(), ideal())
                                  .robot(discRobot(), {3, 0, 0}, still(), ideal())
                                  .object(ballType(), {0, 2, 0})
                                  .scenario();
    SensorWatch watch(scenario, 22);
    const double kept = std::exp(-0.1 / 2), added = std::sqrt(1 - kept * kept);
    StandardNormals innovations;
    double last = 0;
    for (int i = 0; i < 20000; ++i) {
        const Observation& now = watch.next();
        const Point ball = now.objects()[0].position_B, robot = now.robots()[0].position_B;
        const double bias = std::atan2(-ball.x, ball.y) / 0.04;
        EXPECT_NEAR(std::atan2(robot.y, robot.x) / 0.02, bias, 1e-9);
        EXPECT_NEAR(length(ball), 2, 1e-12);
        if (i > 0) innovations.add((bias - kept * last) / added);
        last = bias;
    }
    innovations.expectStandard("innovations");
}

TEST(BodySight, FieldOfViewEndsAtItsEdge) {
    for (const double view : {pi / 2, pi, 1.5 * pi}) {
        const double edge = view / 2, little = 1e-9;
        const Scenario scenario = ballsAround(
            {.fieldOfView = view}, {{3, edge - little}, {3, edge + little}, {3, -edge + little}, {3, -edge - little}});
        EXPECT_EQ(indices(SensorWatch(scenario, 1).next().objects()), (std::vector<std::uint32_t>{0, 2})) << view;
    }
    const Scenario allRound = ballsAround({}, {{3, pi}, {3, 0}, {3, -2}});
    EXPECT_EQ(SensorWatch(allRound, 1).next().objects().size(), 3u);
}

TEST(BodySight, LooksWhereItIsDirectedAndGivesPlacesInTheRobotsFrame) {
    for (const std::size_t count : {12u, 300u})  // one by one, and by what is in reach
        for (const double direction : {pi, -2.2, 0.6}) {
            std::vector<std::pair<double, double>> places;
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < count; ++i) {
                const double bearing = 2 * pi * (i + 0.5) / static_cast<double>(count);
                places.emplace_back(20, bearing);
                if (std::abs(std::remainder(bearing - direction, 2 * pi)) < 0.5) expected.push_back(i);
            }
            const Scenario scenario = ballsAround({.fieldOfView = 1, .direction = direction, .range = 21}, places);
            SensorWatch watch(scenario, 1);
            const std::span<const SeenBody> seen = watch.next().objects();
            EXPECT_EQ(indices(seen), expected) << count << ' ' << direction;
            for (const SeenBody& body : seen) {
                const double bearing = places[body.index].second;
                EXPECT_NEAR(body.position_B.x, 20 * std::cos(bearing), 1e-9);
                EXPECT_NEAR(body.position_B.y, 20 * std::sin(bearing), 1e-9);
            }
        }
}

TEST(BodySight, RangeEndsAtItsEdge) {
    const Scenario scenario = ballsAround({.range = 2}, {{2 - 1e-9, 1}, {2 + 1e-9, 1}, {1e6, 1}});
    EXPECT_EQ(indices(SensorWatch(scenario, 1).next().objects()), std::vector<std::uint32_t>{0});
}

TEST(BodySight, DropsOutByItsRateBodyByBody) {
    const Scenario scenario = ballsAround({.dropOut = 0.2}, {{2, 0}, {2, 1}});
    SensorWatch watch(scenario, 23);
    int first = 0, second = 0, both = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
        bool seen[2] = {};
        for (const SeenBody& body : watch.next().objects()) seen[body.index] = true;
        first += seen[0] ? 0 : 1;
        second += seen[1] ? 0 : 1;
        both += seen[0] || seen[1] ? 0 : 1;
    }
    expectRate(first, n, 0.2);
    expectRate(second, n, 0.2);
    expectRate(both, n, 0.04);
}

TEST(BodySight, SeesWhatWasThereInTheObserversFrameOfThen) {
    Perception perception;
    perception.robots.latency = 60 * ms;
    perception.objects.latency = 160 * ms;
    const Pose other{3, 0.5, 2};
    const Scenario scenario =
        SmallWorld()
            .robot(perceiving(perception), start, std::make_shared<const Told>(Command{0.5, 1}), ideal())
            .robot(discRobot(), other, std::make_shared<const Told>(Command{0.3, -1}), ideal(), 3)
            .object(ballType(), {-1, 2, 0}, {0.6, 0.2, 0})
            .scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    std::vector<WorldState> past;
    for (std::int64_t tick = 0; tick < 60; ++tick) {
        past.push_back(state);
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        if (!trace.robots[0].observed || tick < 8) continue;
        const Observation& now = trace.robots[0].observation;
        const auto inFrame = [&](std::int64_t lag, std::size_t body) {
            const WorldState& then = past[static_cast<std::size_t>(tick - lag)];
            return position(relative(then.robots[0].pose, Scenario::poseOf(then, body)));
        };
        ASSERT_EQ(now.robots().size(), 1u);
        ASSERT_EQ(now.objects().size(), 1u);
        EXPECT_LT(distance(now.robots()[0].position_B, inFrame(3, 1)), 1e-12) << tick;
        EXPECT_LT(distance(now.objects()[0].position_B, inFrame(8, 2)), 1e-12) << tick;
        EXPECT_EQ(now.robots()[0].measured, (tick - 3) * 20 * ms);
        EXPECT_EQ(now.objects()[0].measured, (tick - 8) * 20 * ms);
        EXPECT_GT(distance(now.objects()[0].position_B, inFrame(7, 2)), 1e-4);
    }
}

TEST(BodySight, BlindRobotSeesNothing) {
    const Scenario scenario = ballsAround({.present = false}, {{2, 0}});
    EXPECT_TRUE(SensorWatch(scenario, 1).next().objects().empty());
}

}  // namespace
}  // namespace mrose
