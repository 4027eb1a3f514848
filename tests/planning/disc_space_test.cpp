#include "planning/disc_space.h"

#include <gtest/gtest.h>

#include "planning/planning_worlds.h"

namespace mrose {
namespace {

/// The distance of a point from a piece by walking round its outline.
double sampledDistance(const ConvexPiece& piece, const Point& place) {
    double least = 1e9;
    bool inside = true;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point a = piece.corners[i], b = piece.corners[piece.cornerAfter(i)];
        if (!piece.isCircle() && cross(b - a, place - a) < 0) inside = false;
        for (int k = 0; k <= 400; ++k) least = std::min(least, distance(place, a + (k / 400.0) * (b - a)));
    }
    if (piece.isCircle()) return least - piece.radius;
    return inside ? -least : least;
}

TEST(DiscSpace, DistancesAreThoseOfSampledOutlinesAndWays) {
    for (std::int64_t world = 0; world < 40; ++world) {
        const DiscSpace space = drawnRoom(3, world);
        for (std::uint32_t i = 0; i < 10; ++i) {
            const Point a{drawnNumber(4, world, 10 * i, 0, 6), drawnNumber(4, world, 10 * i + 1, 0, 4)},
                b{drawnNumber(4, world, 10 * i + 2, 0, 6), drawnNumber(4, world, 10 * i + 3, 0, 4)};
            double nearest = 5, onWay = 5;
            for (const ConvexPiece& piece : space.pieces()) nearest = std::min(nearest, sampledDistance(piece, a));
            for (int k = 0; k <= 300; ++k) {
                const Point place = a + (k / 300.0) * (b - a);
                for (const ConvexPiece& piece : space.pieces())
                    onWay = std::min(onWay, nearestPoint(piece, place).distance);
            }
            EXPECT_NEAR(space.distance(a, 5), nearest, 0.005) << world;
            EXPECT_NEAR(space.distance(a, b, 5), std::max(0.0, onWay), 0.02) << world;
            EXPECT_LE(space.distance(a, b, 5), std::max(0.0, onWay) + 1e-12) << world;
            EXPECT_EQ(space.free(a, b), !space.firstInTheWay(a, b).has_value());
        }
    }
}

TEST(DiscSpace, APieceInTheWayIsTheFirstThatIsMet) {
    const DiscSpace space({ConvexPiece::circle({3, 0}, 0.2), ConvexPiece::circle({1, 0.1}, 0.2)}, 0.3);
    EXPECT_EQ(space.firstInTheWay({0, 0}, {4, 0}), 1u);
    EXPECT_EQ(space.firstInTheWay({4, 0}, {0, 0}), 0u);
    EXPECT_FALSE(space.firstInTheWay({0, 2}, {4, 2}));
    EXPECT_TRUE(space.free({0, 0.6000001}, {2, 0.6000001}));
}

TEST(DiscSpace, WhoIsTooNearIsFreedByTheShortestWay) {
    const DiscSpace box({boxPiece({0, 0, 0}, 2, 1)}, 0.3);
    const Point freed = *box.freed({0.9, 0.2});
    EXPECT_NEAR(freed.x, 1.3, 1e-12);
    EXPECT_NEAR(freed.y, 0.2, 1e-12);
    EXPECT_EQ(*box.freed({3, 3}), (Point{3, 3}));
    for (std::int64_t world = 0; world < 100; ++world) {
        const DiscSpace space = drawnRoom(5, world);
        const Point place{drawnNumber(6, world, 0, 0.3, 5.7), drawnNumber(6, world, 1, 0.3, 3.7)};
        if (const auto free = space.freed(place)) {
            EXPECT_TRUE(space.free(*free)) << world;
        }
    }
}

TEST(DiscSpace, WhoHasNoRoomAroundIsNotFreed) {
    const DiscSpace space({boxPiece({0, 0, 0}, 20, 20)}, 0.3);
    EXPECT_FALSE(space.freed({0, 0}));
}

}  // namespace
}  // namespace mrose
