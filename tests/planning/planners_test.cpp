// What holds of all planners, and of each that is no exact one.
#include <bit>
#include <cmath>

#include <gtest/gtest.h>

#include "planning/planner.h"
#include "planning/planning_worlds.h"
#include "planning/potential_field.h"
#include "planning/via_points.h"
#include "planning/visibility_graph.h"

namespace mrose {
namespace {

constexpr std::array planners{Planner::potentialField, Planner::visibilityGraph, Planner::voronoi, Planner::viaPoints};

TEST(Planners, PathsAreFreeWholeAndNoShorterThanTheShortest) {
    std::array<int, 4> found{};
    int ways = 0;
    for (std::int64_t world = 0; world < 100; ++world) {
        const DiscSpace space = drawnRoom(31, world);
        const Point start = drawnPlace(space, 32, world, 0), goal = drawnPlace(space, 32, world, 1000);
        const Path shortest = shortestPath(space, start, goal);
        if (shortest.found()) ++ways;
        for (const Planner planner : planners) {
            const Path path = PathFinder(planner, space).path(start, goal);
            if (!path.found()) {
                EXPECT_TRUE(path.parts.empty());
                continue;
            }
            ++found[static_cast<std::size_t>(planner)];
            ASSERT_TRUE(shortest.found()) << world;
            EXPECT_EQ(path.parts.front().from, start);
            EXPECT_EQ(path.parts.back().to, goal);
            EXPECT_GE(lengthOf(path), lengthOf(shortest) - 1e-6) << world;
            EXPECT_GE(leastDistanceOf(path, space), 0.25 - 2e-4) << world;
            double length = 0;
            for (std::size_t i = 0; i < path.parts.size(); ++i) {
                length += path.parts[i].length();
                if (i > 0) {
                    EXPECT_EQ(path.parts[i - 1].to, path.parts[i].from);
                }
            }
            EXPECT_DOUBLE_EQ(lengthOf(path), length);
            const std::vector<Point> points = pointsOf(path);
            EXPECT_EQ(points.front(), start);
            EXPECT_EQ(points.back(), goal);
            for (std::size_t i = 1; i < points.size(); ++i)
                EXPECT_GE(space.distance(points[i - 1], points[i], 1), 0.25 - 0.005) << world;
        }
    }
    EXPECT_GE(ways, 80);
    for (const int count : found) EXPECT_GE(count, 0.85 * ways);
}

TEST(Planners, TheSameBitsEveryTime) {
    for (std::int64_t world = 0; world < 20; ++world) {
        const DiscSpace space = drawnRoom(33, world), again = drawnRoom(33, world);
        const Point start = drawnPlace(space, 34, world, 0), goal = drawnPlace(space, 34, world, 1000);
        for (const Planner planner : planners) {
            const Path one = PathFinder(planner, space).path(start, goal),
                       two = PathFinder(planner, again).path(start, goal);
            ASSERT_EQ(one.parts.size(), two.parts.size());
            EXPECT_EQ(std::bit_cast<std::uint64_t>(lengthOf(one)), std::bit_cast<std::uint64_t>(lengthOf(two)));
        }
    }
}

TEST(Planners, NoWayAndBlockedEndsAreSaid) {
    std::vector<ConvexPiece> pieces = room(6, 4);
    pieces.push_back(boxPiece({3, 2, 0}, 0.4, 4));
    const DiscSpace barred(pieces, 0.25), block({boxPiece({0, 0, 0}, 20, 20)}, 0.25);
    for (const Planner planner : planners) {
        EXPECT_EQ(PathFinder(planner, barred).path({1, 2}, {5, 2}).outcome, Path::Outcome::noWay);
        EXPECT_EQ(PathFinder(planner, block).path({1, 2}, {15, 2}).outcome, Path::Outcome::startBlocked);
        EXPECT_EQ(PathFinder(planner, block).path({15, 2}, {5, 2}).outcome, Path::Outcome::goalBlocked);
    }
}

TEST(Planners, EndsTooNearToAPieceLeaveItFirst) {
    std::vector<ConvexPiece> pieces = room(6, 4);
    pieces.push_back(boxPiece({3, 2, 0}, 1, 1));
    const DiscSpace space(pieces, 0.25);
    for (const Planner planner : planners) {
        const Path path = PathFinder(planner, space).path({2.4, 2}, {3.6, 2});
        ASSERT_TRUE(path.found());
        EXPECT_NEAR(path.parts.front().to.x, 2.25, 1e-9);
        EXPECT_NEAR(path.parts.back().from.x, 3.75, 1e-9);
    }
}

/// A cup that is open towards the start.
DiscSpace cup() {
    return {{boxPiece({4, 2, 0}, 0.2, 1.6), boxPiece({3.5, 2.7, 0}, 1, 0.2), boxPiece({3.5, 1.3, 0}, 1, 0.2)}, 0.2};
}

TEST(PotentialField, SaysThatItCameIntoALocalMinimumAndFindsOut) {
    const DiscSpace space = cup();
    const PotentialFieldPath path = potentialFieldPath(space, {1, 2.05}, {5, 2});
    EXPECT_GE(path.localMinima, 1u);
    EXPECT_NEAR(path.lastMinimum.x, 3.6, 0.35);
    ASSERT_TRUE(path.path.found());
    EXPECT_GE(leastDistanceOf(path.path, space), 0.2 - 1e-5);
    const PotentialFieldPath straight = potentialFieldPath(space, {5, 1}, {5, 3});
    EXPECT_EQ(straight.localMinima, 0u);
}

/// Between two discs nothing pushes to the side: by symmetry the way is the line.
TEST(PotentialField, BetweenEqualDiscsItGoesThroughTheMiddle) {
    const DiscSpace space({ConvexPiece::circle({2, 1}, 0.3), ConvexPiece::circle({2, -1}, 0.3)}, 0.25);
    const PotentialFieldPath path = potentialFieldPath(space, {0, 0}, {4, 0});
    ASSERT_TRUE(path.path.found());
    EXPECT_NEAR(lengthOf(path.path), 4, 1e-9);
    EXPECT_EQ(path.localMinima, 0u);
}

TEST(PotentialField, KeepsOffWhatItPasses) {
    const DiscSpace space({ConvexPiece::circle({2, -0.4}, 0.3)}, 0.25);
    const Path path = potentialFieldPath(space, {0, 0}, {4, 0}).path;
    ASSERT_TRUE(path.found());
    EXPECT_GT(leastDistanceOf(path, space), 0.3);
    EXPECT_LT(lengthOf(path), 4.3);
}

TEST(ViaPoints, OneBesideTheMiddleOfASmallPiece) {
    const DiscSpace space({ConvexPiece::circle({2, 0.1}, 0.3)}, 0.25);
    const Path path = viaPointPath(space, {0, 0}, {4, 0});
    ASSERT_EQ(path.parts.size(), 2u);
    EXPECT_NEAR(path.parts[0].to.x, 2, 1e-12);
    EXPECT_NEAR(path.parts[0].to.y, 0.1 - 0.3 - 0.25 - 0.05, 1e-12);
}

TEST(ViaPoints, TwoAtTheEndsOfALongOne) {
    const DiscSpace space({boxPiece({2, 0.1, 0}, 2, 0.4)}, 0.25);
    const Path path = viaPointPath(space, {0, 0}, {4, 0});
    ASSERT_EQ(path.parts.size(), 3u);
    EXPECT_NEAR(path.parts[1].from.x, 1 - 0.15, 1e-12);
    EXPECT_NEAR(path.parts[1].to.x, 3 + 0.15, 1e-12);
    EXPECT_NEAR(path.parts[1].from.y, 0.1 - 0.2 - 0.25 - 0.05, 1e-12);
}

}  // namespace
}  // namespace mrose
