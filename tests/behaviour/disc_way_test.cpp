#include "behaviour/disc_way.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"

namespace mrose {
namespace {

constexpr double reach = 3;  // m

TEST(DiscWay, StraightOnItEndsWhereTheClosedFormSays) {
    const std::vector<Point> ahead{{2, 0}}, aside{{2, 0.3}}, past{{2, 0.5}}, behind{{-1, 0}};
    EXPECT_DOUBLE_EQ(straightWay(ahead, {1, 0}, 0.5, reach), 1.5);
    EXPECT_DOUBLE_EQ(straightWay(aside, {1, 0}, 0.5, reach), 2 - 0.4);
    EXPECT_EQ(straightWay(past, {1, 0}, 0.5, reach), reach) << "it grazes it";
    EXPECT_EQ(straightWay(behind, {1, 0}, 0.5, reach), reach);
    EXPECT_DOUBLE_EQ(straightWay(behind, {-1, 0}, 0.5, reach), 0.5);
    EXPECT_DOUBLE_EQ(straightWay(ahead, {1, 0}, 0.5, 1.2), 1.2);
    EXPECT_EQ(straightWay({}, {1, 0}, 0.5, reach), reach);
}

/// A point on the path itself, a quarter of a turn away: the chord from there to the disc's middle is the radius.
TEST(DiscWay, OnAnArcItEndsWhereTheClosedFormSays) {
    for (const double v : {0.5, -0.5})
        for (const double w : {0.25, -0.25}) {
            const double turn = 2, radius = 0.4;
            const std::vector<Point> quarter{{std::copysign(turn, v), std::copysign(turn, v * w)}};
            const double expected = turn * (std::acos(-1.0) / 2 - 2 * std::asin(radius / (2 * turn)));
            EXPECT_NEAR(arcWay(quarter, {v, w}, radius, reach), expected, 1e-12) << v << ' ' << w;
        }
}

TEST(DiscWay, OnTheSpotItMeetsNothing) {
    const std::vector<Point> near{{0.1, 0}, {0, -0.2}};
    EXPECT_EQ(arcWay(near, {0, 0.7}, 0.5, reach), reach);
    EXPECT_EQ(arcWay(near, {0, 0}, 0.5, reach), reach);
}

TEST(DiscWay, WhatItTouchesEndsItsWayOnlyWhereItWouldComeNearer) {
    const std::vector<Point> front{{0.3, 0.1}}, rear{{-0.3, 0.1}};
    for (const double w : {0.0, 0.4, -0.4}) {
        EXPECT_EQ(arcWay(front, {0.5, w}, 0.5, 1), 0) << w;
        EXPECT_EQ(arcWay(rear, {-0.5, w}, 0.5, 1), 0) << w;
        EXPECT_EQ(arcWay(front, {-0.5, w}, 0.5, 1), 1) << w;
        EXPECT_EQ(arcWay(rear, {0.5, w}, 0.5, 1), 1) << w;
    }
}

/// Where it ends the nearest point is just as far as the radius, and never nearer on the way there.
TEST(DiscWay, AgreesWithGoingThereStepByStep) {
    int ended = 0;
    for (std::int64_t i = 0; i < 3000; ++i) {
        const Velocity velocity{draw(5, i, 0, -1, 1), i % 10 == 0 ? 0 : draw(5, i, 1, -2, 2)};
        const double radius = draw(5, i, 2, 0.05, 0.6);
        std::vector<Point> points;
        for (std::uint32_t k = 0; k < 6; ++k) {
            const Point point{draw(5, i, 10 + 2 * k, -3, 3), draw(5, i, 11 + 2 * k, -3, 3)};
            if (length(point) > radius + 1e-6) points.push_back(point);
        }
        const double way = arcWay(points, velocity, radius, reach);
        const auto nearestAfter = [&](double gone) {
            const double time = gone / std::abs(velocity.v);
            const Point at = position(exp({velocity.v * time, 0, velocity.w * time}));
            double nearest = 1e9;
            for (const Point& point : points) nearest = std::min(nearest, distance(at, point));
            return nearest;
        };
        constexpr int steps = 500;
        for (int k = 0; k < steps; ++k) ASSERT_GE(nearestAfter(way * k / steps), radius - 1e-9) << i;
        if (way == reach) continue;
        ++ended;
        EXPECT_NEAR(nearestAfter(way), radius, 1e-6) << i;
        if (velocity.w == 0) {
            EXPECT_NEAR(straightWay(points, {std::copysign(1, velocity.v), 0}, radius, reach), way, 1e-12);
        }
    }
    EXPECT_GT(ended, 500);
}

}  // namespace
}  // namespace mrose
