#include "behaviour/floor_plan.h"

#include <numbers>

#include <gtest/gtest.h>

#include "behaviour/pushing_way.h"
#include "behaviour/small_field.h"

namespace mrose {
namespace {

const ConvexPiece block = *ConvexPiece::polygon({{2, 1}, {4, 1}, {4, 2}, {2, 2}});
const ConvexPiece pillar = ConvexPiece::circle({-2, 0}, 0.5);

void expectNear(const Point& a, const Point& b) { EXPECT_LT(distance(a, b), 1e-12) << a.x << ' ' << a.y; }
Point pointing(double angle) { return Placement({0, 0, angle}).rotate({1, 0}); }

TEST(FloorPlan, TellsTheNearestPointOfEachPiece) {
    const FloorPlan plan({block, pillar});
    const auto only = [&](const Point& place) {
        const std::vector<FloorPlan::Wall> walls = plan.wallsNear(place, 1);
        EXPECT_EQ(walls.size(), 1u);
        return walls.empty() ? FloorPlan::Wall{} : walls[0];
    };
    const FloorPlan::Wall edge = only({3, 0.4}), corner = only({1.7, 0.6}), inside = only({3.9, 1.5}),
                          round = only({-2, -0.8});
    EXPECT_EQ(edge.nearest, (Point{3, 1}));
    EXPECT_EQ(edge.away, (Point{0, -1}));
    EXPECT_NEAR(edge.distance, 0.6, 1e-12);
    EXPECT_EQ(corner.nearest, (Point{2, 1}));
    EXPECT_NEAR(corner.distance, 0.5, 1e-12);
    EXPECT_LT(distance(corner.away, {-0.6, -0.8}), 1e-12);
    EXPECT_NEAR(inside.distance, -0.1, 1e-12);
    EXPECT_EQ(inside.away, (Point{1, 0}));
    EXPECT_NEAR(round.distance, 0.3, 1e-12);
    EXPECT_LT(distance(round.away, {0, -1}), 1e-12);
    EXPECT_TRUE(plan.wallsNear({0, 1.5}, 1).empty());
    EXPECT_EQ(plan.wallsNear({0, 0.5}, 2.5).size(), 2u);
}

/// Against a disc moved in millimetres until it is too near.
TEST(FloorPlan, FreeWayEndsWhereTheDiscTouches) {
    const FloorPlan plan({block, pillar});
    for (std::int64_t i = 0; i < 200; ++i) {
        const Point start{draw(5, i, 0, -1, 1.5), draw(5, i, 1, -3, 0.5)};
        const Point direction = pointing(draw(5, i, 2, -std::numbers::pi, std::numbers::pi));
        const double radius = draw(5, i, 3, 0, 0.3), most = 4;
        double way = 0;
        const auto clear = [&](double at) {
            const ConvexPiece disc = ConvexPiece::circle(start + at * direction, radius);
            return distance(disc, block) >= 0 && distance(disc, pillar) >= 0;
        };
        while (way < most && clear(way)) way += 0.001;
        EXPECT_NEAR(plan.freeWay(start, direction, radius, most), std::min(way, most), 0.003) << i;
    }
    EXPECT_EQ(FloorPlan().freeWay({}, {1, 0}, 0.3, 7), 7);
}

TEST(FloorPlan, WhoStandsAtAWallMayLeaveIt) {
    const FloorPlan plan({block});
    const Point touching{3, 0.8};
    EXPECT_EQ(plan.freeWay(touching, {0, 1}, 0.2, 1), 0);
    EXPECT_EQ(plan.freeWay(touching, {0, -1}, 0.2, 1), 1);
    EXPECT_EQ(plan.freeWay(touching, {1, 0}, 0.2, 1), 1);
    EXPECT_EQ(plan.freeWay(touching, pointing(-0.3), 0.25, 1), 1) << "a little into it, too";
}

/// A quarter of the plane: walls west and south of it.
class Corner : public testing::Test {
protected:
    PushingWay way(const Point& ball, double onwards) const {
        return pushingWay(ball, pointing(onwards), plan_.wallsNear(ball, 1), pusher_);
    }
    const FloorPlan plan_{{*ConvexPiece::polygon({{-1, -1}, {5, -1}, {5, 0}, {-1, 0}}),
                           *ConvexPiece::polygon({{-1, 0}, {0, 0}, {0, 5}, {-1, 5}})}};
    const Pusher pusher_{0.35, 0.22, 0.11};
};

TEST_F(Corner, FarFromWallsABallIsPushedOnwards) {
    for (const double angle : {0.0, 1.3, 2.9, -1.8}) {
        const PushingWay free = way({2, 2}, angle);
        EXPECT_EQ(free.direction, pointing(angle));
        EXPECT_FALSE(free.cornered);
        EXPECT_EQ(free.out, Point{});
    }
}

/// Every way has room for the robot behind the ball, is as near to onwards as the steps allow, and leads along the
/// wall.
TEST_F(Corner, AtAWallABallIsPushedAlongIt) {
    const Point ball{3, 0.11};
    for (const double angle : {0.6, 1.2, 1.9, 2.6, -0.9, -2.2}) {
        const PushingWay along = way(ball, angle);
        EXPECT_FALSE(along.cornered);
        EXPECT_EQ(along.out, (Point{0, 1}));
        EXPECT_GE((ball - pusher_.behind * along.direction).y, pusher_.room - 1e-12) << angle;
        EXPECT_GT(along.direction.x * pointing(angle).x, 0.25 * std::abs(pointing(angle).x)) << angle;
    }
    // Where there is room, onwards it is.
    EXPECT_EQ(way({3, 0.11}, -0.6).direction, pointing(-0.6));
}

TEST_F(Corner, OutOfACornerNoPushLeads) {
    for (const double angle : {0.1, 0.8, 1.5, 2.4, -2.4}) {
        const PushingWay none = way({0.12, 0.13}, angle);
        EXPECT_TRUE(none.cornered) << angle;
        expectNear(none.out, {1, 1});
        const Point start = Point{0.12, 0.13} - pusher_.behind * none.direction;
        EXPECT_TRUE(start.x >= pusher_.room && start.y >= pusher_.room) << angle;
    }
    EXPECT_FALSE(way({0.4, 0.13}, 0.1).cornered);
}

TEST_F(Corner, PointsAreMovedClearOfWalls) {
    const Point ball{0.3, 0.3};
    const auto walls = plan_.wallsNear(ball, 1);
    expectNear(clearOf(walls, {-1.4, -0.1}, 0.2), {0.2, 0.2});  // not through the wall to its other side
    expectNear(clearOf(walls, {0.7, -2}, 0.2), {0.7, 0.2});
    EXPECT_EQ(clearOf(walls, {0.7, 0.5}, 0.2), (Point{0.7, 0.5}));
}

}  // namespace
}  // namespace mrose
