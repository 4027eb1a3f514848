#include "planning/voronoi_roadmap.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planning/planning_worlds.h"
#include "planning/visibility_graph.h"

namespace mrose {
namespace {

/// How far a place is from the nearest piece and from the nearest other one.
std::pair<double, double> twoNearest(const DiscSpace& space, const Point& place) {
    double first = 1e9, second = 1e9;
    for (const ConvexPiece& piece : space.pieces()) {
        const double far = nearestPoint(piece, place).distance;
        if (far < first)
            second = std::exchange(first, far);
        else
            second = std::min(second, far);
    }
    return {first, second};
}

TEST(VoronoiRoadmap, EachNodeIsAsFarFromTwoPieces) {
    std::size_t nodes = 0;
    for (std::int64_t world = 0; world < 40; ++world) {
        const DiscSpace space = drawnRoom(21, world);
        const VoronoiRoadmap roadmap(space);
        for (const VoronoiRoadmap::Node& node : roadmap.nodes()) {
            const auto [first, second] = twoNearest(space, node.place);
            EXPECT_NEAR(node.distance, first, 1e-12);
            EXPECT_GE(first, 0.25);
            // Pieces are points there, some way apart.
            EXPECT_LE(second - first, 0.1) << world << ": " << node.place.x << ' ' << node.place.y;
            ++nodes;
        }
    }
    EXPECT_GE(nodes, 1000u);
}

/// Between two boxes it goes through the middle, where clearance across the way is greatest.
TEST(VoronoiRoadmap, InACorridorItKeepsToTheMiddle) {
    std::vector<ConvexPiece> pieces{boxPiece({0, 0.9, 0}, 4, 1), boxPiece({0, -0.5, 0}, 4, 0.6)};
    for (const Point& centre : {Point{-4, 0}, Point{4, 0}}) pieces.push_back(boxPiece({centre.x, 0, 0}, 0.2, 6));
    for (const double y : {3.0, -3.0}) pieces.push_back(boxPiece({0, y, 0}, 8, 0.2));
    const DiscSpace space(pieces, 0.2);
    const Path path = VoronoiRoadmap(space).path({-2.8, 0.1}, {2.8, 0.0});
    ASSERT_TRUE(path.found());
    for (double x = -1.5; x <= 1.5; x += 0.25) {
        bool crossed = false;
        for (const PathPart& part : path.parts)
            if (part.from.x <= x && part.to.x > x) {
                const double y =
                    part.from.y + (x - part.from.x) / (part.to.x - part.from.x) * (part.to.y - part.from.y);
                EXPECT_NEAR(y, (0.4 - 0.2) / 2, 1e-3);
                crossed = true;
            }
        EXPECT_TRUE(crossed) << x;
    }
    EXPECT_NEAR(leastDistanceOf(path, space), 0.3, 0.1);
}

TEST(VoronoiRoadmap, FindsAWayWhereThereIsOneWithMoreRoom) {
    int both = 0, missed = 0;
    double clearance = 0, shortest = 0;
    for (std::int64_t world = 0; world < 80; ++world) {
        const DiscSpace space = drawnRoom(22, world);
        const Point start = drawnPlace(space, 23, world, 0), goal = drawnPlace(space, 23, world, 1000);
        const Path path = VoronoiRoadmap(space).path(start, goal), other = shortestPath(space, start, goal);
        EXPECT_TRUE(other.found() || !path.found()) << world;
        if (other.found() && !path.found()) ++missed;
        if (!path.found() || !other.found()) continue;
        ++both;
        EXPECT_GE(lengthOf(path), lengthOf(other) - 1e-6) << world;
        EXPECT_GE(leastDistanceOf(path, space), 0.25 - 1e-5) << world;
        // Start and goal themselves are as near to pieces as they are: count what lies between.
        double least = farthestDistance, others = farthestDistance;
        for (std::size_t i = 1; i + 1 < path.parts.size(); ++i)
            least = std::min(least, space.distance(path.parts[i].from, path.parts[i].to, farthestDistance));
        for (std::size_t i = 1; i + 1 < other.parts.size(); ++i)
            others = std::min(others, space.distance(other.parts[i].from, other.parts[i].to, farthestDistance));
        if (path.parts.size() < 3 || other.parts.size() < 3) continue;
        clearance += least;
        shortest += others;
    }
    EXPECT_GE(both, 60);
    EXPECT_EQ(missed, 0);
    EXPECT_GT(clearance, 1.2 * shortest);
}

TEST(VoronoiRoadmap, AlsoWherePiecesTouchOverlapOrAreTheSame) {
    std::vector<ConvexPiece> pieces = room(6, 4);
    for (int i = 0; i < 2; ++i) pieces.push_back(boxPiece({2, 2, 0.3}, 1, 1));
    pieces.push_back(boxPiece({2.5, 2, 0.3}, 1, 1));
    pieces.push_back(boxPiece({3.5, 2, 0}, 1, 0.3));
    pieces.push_back(boxPiece({4.5, 2, 0}, 1, 0.3));
    pieces.push_back(ConvexPiece::circle({4.5, 2}, 0.3));
    const DiscSpace space(pieces, 0.2);
    const Path path = VoronoiRoadmap(space).path({3, 0.6}, {3, 3.4});
    ASSERT_TRUE(path.found());
    EXPECT_GE(leastDistanceOf(path, space), 0.2 - 1e-5);
}

}  // namespace
}  // namespace mrose
