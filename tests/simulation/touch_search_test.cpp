#include "simulation/touch_search.h"

#include <gtest/gtest.h>

#include "support/scenes.h"
#include "world/noise.h"

namespace mrose {
namespace {

double draw(std::int64_t tick, std::uint32_t channel) { return uniformNoise({3, tick, 0, channel}); }

/// Bodies strewn over a field, some of them on its walls.
struct Strewn {
    explicit Strewn(std::uint32_t count, double width = 12, double height = 8)
        : environment(walledField(width, height)), obstacles(environment, 1) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto& shape = i % 3 == 0 ? ball.shape : i % 3 == 1 ? square.shape : disc.shape;
            bodies.push_back({shape.get(),
                              {(width + 2) * draw(i, 0) - 1, (height + 2) * draw(i, 1) - 1, 6 * draw(i, 2)},
                              0.05 * draw(i, 3)});
        }
    }
    RobotType square = squareRobot(), disc = discRobot();
    ObjectType ball = ballType();
    Environment environment;
    ObstacleIndex obstacles;
    std::vector<SweptBody> bodies;
};

double exactDistance(const SweptBody& a, const ConvexPiece& b) {
    double least = 1e9;
    for (const ConvexPiece& piece : a.shape->pieces)
        least = std::min(least, distance(placed(piece, Placement(a.pose)), b));
    return least;
}

double exactDistance(const SweptBody& a, const SweptBody& b) {
    double least = 1e9;
    for (const ConvexPiece& piece : b.shape->pieces)
        least = std::min(least, exactDistance(a, placed(piece, Placement(b.pose))));
    return least;
}

TEST(TouchSearch, FindsAllThatMayTouchAndFewOthers) {
    for (const std::uint32_t count : {5U, 24U, 25U, 120U, 600U}) {
        const Strewn strewn(count);
        TouchSearch search;
        search.find(strewn.bodies, strewn.obstacles);
        std::vector<TouchSearch::Pair> expected, expectedObstacles;
        int near = 0;
        for (std::uint32_t a = 0; a < count; ++a) {
            for (std::uint32_t b = a + 1; b < count; ++b) {
                const double limit = strewn.bodies[a].travel + strewn.bodies[b].travel;
                const double d = exactDistance(strewn.bodies[a], strewn.bodies[b]);
                if (d <= limit) expected.push_back({a, b});
                near += d <= limit + 0.2;
            }
            for (std::uint32_t piece = 0; piece < strewn.obstacles.pieces().size(); ++piece)
                if (exactDistance(strewn.bodies[a], strewn.obstacles.pieces()[piece]) <= strewn.bodies[a].travel)
                    expectedObstacles.push_back({a, piece});
        }
        const auto& found = search.bodyPairs();
        const auto& foundObstacles = search.obstaclePairs();
        EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end())) << count;
        EXPECT_TRUE(std::includes(foundObstacles.begin(), foundObstacles.end(), expectedObstacles.begin(),
                                  expectedObstacles.end()))
            << count;
        EXPECT_LE(found.size(), static_cast<std::size_t>(near));
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
        EXPECT_TRUE(std::adjacent_find(found.begin(), found.end()) == found.end());
    }
}

TEST(TouchSearch, GridAndAllPairsFindTheSame) {
    const Strewn strewn(200);
    TouchSearch all, part;
    all.find(strewn.bodies, strewn.obstacles);
    // The first 20 alone are few enough for all pairs.
    part.find(std::span(strewn.bodies).first(20), strewn.obstacles);
    std::vector<TouchSearch::Pair> among;
    for (const TouchSearch::Pair& pair : all.bodyPairs())
        if (pair.b < 20) among.push_back(pair);
    EXPECT_EQ(among, part.bodyPairs());
}

TEST(TouchSearch, BodyFasterThanTheIndexLooksAtAllObstacles) {
    const RobotType square = squareRobot();
    const Environment environment = walledField(100, 100);
    const ObstacleIndex obstacles(environment, 0.5);
    const SweptBody fast{square.shape.get(), {50, 50, 0}, 60};
    TouchSearch search;
    search.find({&fast, 1}, obstacles);
    EXPECT_EQ(search.obstaclePairs().size(), 4u);
}

}  // namespace
}  // namespace mrose
