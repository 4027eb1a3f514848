#include "planning/visibility_graph.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "planning/planning_worlds.h"

namespace mrose {
namespace {

TEST(VisibilityGraph, WayRoundOneDiscIsTwoTangentsAndAnArc) {
    const double radius = 0.3 + 0.25;
    for (const double aside : {0.0, 0.1, -0.3, 0.5}) {
        const DiscSpace space({ConvexPiece::circle({0, aside}, 0.3)}, 0.25);
        const Point start{-2, 0}, goal{3, 0.2};
        const double a = std::hypot(start.x, start.y - aside), b = std::hypot(goal.x, goal.y - aside);
        const double between = std::abs(
            std::remainder(std::atan2(start.y - aside, start.x) - std::atan2(goal.y - aside, goal.x), 2 * M_PI));
        const double expected = std::sqrt(a * a - radius * radius) + std::sqrt(b * b - radius * radius) +
                                radius * (between - std::acos(radius / a) - std::acos(radius / b));
        const Path path = shortestPath(space, start, goal);
        ASSERT_TRUE(path.found());
        EXPECT_NEAR(lengthOf(path), expected, 1e-12);
        EXPECT_NEAR(leastDistanceOf(path, space), 0.25, 1e-4);
        ASSERT_EQ(path.parts.size(), 3u);
        EXPECT_NEAR(turnsOf(path), std::abs(path.parts[1].angle), 1e-6);
    }
}

TEST(VisibilityGraph, WayRoundABoxTouchesBothCorners) {
    const DiscSpace space({boxPiece({0, 0, 0}, 1, 0.4)}, 0.25);
    const Path path = shortestPath(space, {-2, 0.05}, {2, 0.05});
    const double dx = 1.5, dy = 0.15, far = std::hypot(dx, dy), touch = std::sqrt(far * far - 0.25 * 0.25);
    const double arc = std::atan2(dy, dx) + std::asin(0.25 / far);
    ASSERT_EQ(path.parts.size(), 5u);
    EXPECT_NEAR(lengthOf(path), 2 * (touch + 0.25 * arc) + 1, 1e-9);
}

TEST(VisibilityGraph, FreeWayIsStraight) {
    const DiscSpace space(room(6, 4), 0.25);
    const Path path = shortestPath(space, {1, 1}, {5, 3});
    ASSERT_EQ(path.parts.size(), 1u);
    EXPECT_EQ(turnsOf(path), 0);
    EXPECT_DOUBLE_EQ(lengthOf(path), std::sqrt(20));
    EXPECT_NEAR(leastDistanceOf(path, space), 1, 1e-12);
}

/// A grid's ways are real ways: none is shorter. And with straight ways to many neighbours it is not much longer.
TEST(VisibilityGraph, NoGridFindsAShorterWayAndAFineOneAlmostAsShort) {
    int found = 0, bent = 0;
    for (std::int64_t world = 0; world < 90; ++world) {
        const DiscSpace space = drawnRoom(11, world);
        const Point start = drawnPlace(space, 12, world, 0), goal = drawnPlace(space, 12, world, 1000);
        const Path path = shortestPath(space, start, goal);
        const double grid = gridLength(space, start, goal, 0.05, 4);
        if (!path.found()) {
            EXPECT_EQ(path.outcome, Path::Outcome::noWay);
            EXPECT_TRUE(std::isinf(grid)) << world << ": a grid found a way of " << grid;
            continue;
        }
        ++found;
        if (path.parts.size() > 1) ++bent;
        EXPECT_LE(lengthOf(path), grid + 1e-9) << world;
        if (std::isfinite(grid)) {
            EXPECT_GE(lengthOf(path), 0.97 * grid - 0.1) << world;
        }
        EXPECT_GE(leastDistanceOf(path, space), 0.25 - 2e-4) << world;
        for (std::size_t i = 1; i < path.parts.size(); ++i) EXPECT_EQ(path.parts[i - 1].to, path.parts[i].from);
    }
    EXPECT_GE(found, 65);
    EXPECT_GE(bent, 15);
}

TEST(VisibilityGraph, ABarredRoomHasNoWay) {
    std::vector<ConvexPiece> pieces = room(6, 4);
    pieces.push_back(boxPiece({3, 1.8, 0}, 0.2, 3.6));
    EXPECT_EQ(shortestPath(DiscSpace(pieces, 0.25), {1, 2}, {5, 2}).outcome, Path::Outcome::noWay);
    EXPECT_TRUE(shortestPath(DiscSpace(pieces, 0.15), {1, 2}, {5, 2}).found());
}

TEST(VisibilityGraph, EndsThatAreTooNearComeFirstAndLast) {
    const DiscSpace space({boxPiece({0, 0, 0}, 1, 1)}, 0.25);
    const Path path = shortestPath(space, {-0.6, 0}, {0.6, 0});
    ASSERT_TRUE(path.found());
    EXPECT_EQ(path.parts.front().from, (Point{-0.6, 0}));
    EXPECT_NEAR(path.parts.front().to.x, -0.75, 1e-9);
    EXPECT_EQ(path.parts.back().to, (Point{0.6, 0}));
    EXPECT_NEAR(lengthOf(path), 2 * (0.15 + 0.5 + 1.0 / 2 + 0.25 * std::numbers::pi / 2), 1e-6);
    EXPECT_NEAR(leastDistanceOf(path, space), 0.1, 1e-9);
    const DiscSpace block({boxPiece({0, 0, 0}, 20, 20)}, 0.25);
    EXPECT_EQ(shortestPath(block, {0, 0}, {15, 0}).outcome, Path::Outcome::startBlocked);
    EXPECT_EQ(shortestPath(block, {15, 0}, {0, 0}).outcome, Path::Outcome::goalBlocked);
}

}  // namespace
}  // namespace mrose
