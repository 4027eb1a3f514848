#include "behaviour/way_to_ball.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "behaviour/small_field.h"

namespace mrose {
namespace {

using std::numbers::pi;

TEST(WayToBall, StraightBehindTheBallNothingHasToBeTurned) {
    const WayToBall way({.robot = {1, 2, 0}, .velocity = {0.3, 0}, .ball = {3, 2}, .rolls = {1, 0}, .onwards = {1, 0}});
    EXPECT_NEAR(way.distance, 2, 1e-12);
    EXPECT_NEAR(way.round, 0, 1e-12);
    EXPECT_NEAR(way.bearing, 0, 1e-12);
    EXPECT_NEAR(way.bearingCosine, 1, 1e-12);
    EXPECT_EQ(way.speed, 0.3);
    EXPECT_NEAR(way.rollsAway, 1, 1e-12);
    EXPECT_NEAR(way.rollsAside, 0, 1e-12);
    EXPECT_NEAR(way.rest, 2 + 1 / (2 * 0.4), 1e-9) << "1 m/s, slowed by 0.4 m/s2";
    EXPECT_EQ(way.room, WayToBall::farRoom);
    EXPECT_EQ(way.other, WayToBall::farOther);
    EXPECT_EQ(way.blocked + way.crowded + way.stuck, 0);
}

TEST(WayToBall, FromTheWrongSideItGoesAllTheWayRound) {
    const WayToBall way(
        {.robot = {3, 0, 0}, .velocity = {}, .ball = {0, 0}, .rolls = {}, .onwards = {1, 0}, .stuck = 9});
    EXPECT_NEAR(way.round, pi, 1e-12);
    EXPECT_NEAR(std::abs(way.bearing), pi, 1e-12);
    EXPECT_EQ(way.stuck, WayToBall::longStuck);
}

TEST(WayToBall, WallsAreHowFarFromTheBallAndEndItsRoll) {
    const auto walls = floorPlanOf(walledField(9, 5));
    const WayToBall way({.robot = {3, 0.3, 0},
                         .velocity = {},
                         .ball = {6, 0.3},
                         .rolls = {3, 0},
                         .onwards = {1, 0},
                         .walls = walls.get()});
    EXPECT_NEAR(way.room, 0.3, 1e-9);
    EXPECT_NEAR(way.rest, 9 - 0.11 - 3, 2e-3) << "not 3 m/s squared over 0.8 m/s2 farther";
}

WayToBall::Situation situation(std::int64_t which) {
    const auto at = [&](std::uint32_t part, double far) { return draw(7, which, part, -far, far); };
    return {.robot = {at(0, 4), at(1, 2), at(2, 3)},
            .velocity = {at(3, 0.4), at(4, 1)},
            .ball = {at(5, 4), at(6, 2)},
            .rolls = {at(7, 1), at(8, 1)},
            .onwards = towards(at(9, 3)),
            .behind = 0.3};
}

void expectSame(const WayToBall& a, const WayToBall& b) {
    for (std::size_t i = 0; i < WayToBall::count; ++i)
        EXPECT_NEAR(a.numbers()[i], b.numbers()[i], 1e-9) << wayToBallNames.begin()[i];
}

TEST(WayToBall, IsTheSameWhereAllIsMovedTurnedOrMirrored) {
    for (std::int64_t i = 0; i < 50; ++i) {
        WayToBall::Situation here = situation(i), there = here, mirrored = here;
        const Pose moved{draw(8, i, 0, -5, 5), draw(8, i, 1, -5, 5), draw(8, i, 2, -3, 3)};
        const Placement frame(moved);
        const std::vector<Point> bodies{{0.3, 0.2}, {-1, 1}, {2, -0.5}};
        std::vector<Point> bodiesThere, bodiesMirrored;
        for (const Point& body : bodies) {
            bodiesThere.push_back(frame.place(body));
            bodiesMirrored.push_back({body.x, -body.y});
        }
        there.robot = moved * here.robot;
        there.ball = frame.place(here.ball);
        there.rolls = frame.rotate(here.rolls);
        there.onwards = frame.rotate(here.onwards);
        const auto mirror = [](Point& point) { point.y = -point.y; };
        mirrored.robot = {here.robot.x, -here.robot.y, -here.robot.heading};
        mirrored.velocity.w = -here.velocity.w;
        mirror(mirrored.ball);
        mirror(mirrored.rolls);
        mirror(mirrored.onwards);
        here.bodies = bodies;
        there.bodies = bodiesThere;
        mirrored.bodies = bodiesMirrored;
        expectSame(WayToBall(here), WayToBall(there));
        expectSame(WayToBall(here), WayToBall(mirrored));
    }
}

TEST(WayToBall, BodiesCountByHowFarTheyReachIntoTheLaneAndIntoThePlaceBehindTheBall) {
    const std::vector<Point> bodies{{1, 0}, {1.5, -0.5}, {1, 0.8}, {-1, 0}, {3, 0}};
    const WayToBall way({.robot = {},
                         .velocity = {},
                         .ball = {2, 0},
                         .rolls = {},
                         .onwards = {-1, 0},
                         .behind = 0.4,
                         .bodies = bodies});
    EXPECT_NEAR(way.blocked, WayToBall::lane + WayToBall::lane - 0.5, 1e-12);
    EXPECT_NEAR(way.crowded, WayToBall::lane - 0.6, 1e-12) << "the last one, 0.6 m from (2.4, 0)";
    EXPECT_NEAR(way.other, std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace mrose
