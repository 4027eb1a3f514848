#include "simulation/touch_search.h"

#include <algorithm>
#include <optional>
#include <set>
#include <type_traits>

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
            const Pose pose{(width + 2) * draw(i, 0) - 1, (height + 2) * draw(i, 1) - 1, 6 * draw(i, 2)};
            const Pose step{0.05 * draw(i, 3), 0.02 * draw(i, 4), 0.1 * draw(i, 5)};
            bodies.push_back(SweptBody::of(*shape, pose, pose * step));
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

/// The least distance of two bodies on their straight ways, by samples.
template <class Other>
double nearest(const SweptBody& a, const Other& other) {
    constexpr int samples = 50;
    double least = 1e9;
    const auto between = [](const SweptBody& body, double share) {
        SweptBody now = body;
        now.pose = {body.pose.x + share * (body.planned.x - body.pose.x),
                    body.pose.y + share * (body.planned.y - body.pose.y),
                    body.pose.heading + share * (body.planned.heading - body.pose.heading)};
        return now;
    };
    for (int i = 0; i <= samples; ++i) {
        const double share = static_cast<double>(i) / samples;
        if constexpr (std::is_same_v<Other, SweptBody>)
            least = std::min(least, exactDistance(between(a, share), between(other, share)));
        else
            least = std::min(least, exactDistance(between(a, share), other));
    }
    return least;
}

/// What is said of two that do not meet: `least` is their distance on the way, by samples, `now` where they begin.
bool staysApart(double least, double now) {
    constexpr double rounding = 1e-6;
    return least > TouchSearch::margin - rounding || (least > TouchSearch::touching - rounding && least > now - 1e-4);
}

TEST(TouchSearch, FindsAllThatMayTouchAndFewOthers) {
    for (const std::uint32_t count : {5U, 24U, 25U, 120U, 600U}) {
        const Strewn strewn(count);
        TouchSearch search;
        search.find(strewn.bodies, strewn.obstacles);
        const auto found = [](const std::vector<TouchSearch::Pair>& pairs, std::uint32_t a, std::uint32_t b) {
            const auto at = std::find_if(pairs.begin(), pairs.end(),
                                         [&](const TouchSearch::Pair& p) { return p.a == a && p.b == b; });
            return at == pairs.end() ? std::optional<bool>{} : at->meet;
        };
        int far = 0;
        for (std::uint32_t a = 0; a < count; ++a) {
            const SweptBody& own = strewn.bodies[a];
            for (std::uint32_t b = a + 1; b < count; ++b) {
                const auto pair = found(search.bodyPairs(), a, b);
                const double now = exactDistance(own, strewn.bodies[b]);
                EXPECT_TRUE(pair || now > own.travel + strewn.bodies[b].travel) << count << ": " << a << ", " << b;
                if (pair) {
                    const double least = nearest(own, strewn.bodies[b]);
                    EXPECT_TRUE(*pair || staysApart(least, now)) << count << ": " << a << ", " << b << ": " << least;
                    far += *pair && least > 0.03;
                }
            }
            for (std::uint32_t piece = 0; piece < strewn.obstacles.pieces().size(); ++piece) {
                const ConvexPiece& wall = strewn.obstacles.pieces()[piece];
                const auto pair = found(search.obstaclePairs(), a, piece);
                EXPECT_TRUE(pair || exactDistance(own, wall) > own.travel) << count << ": " << a << ", " << piece;
                const double now = exactDistance(own, wall), least = pair ? nearest(own, wall) : now;
                EXPECT_TRUE(!pair || *pair || staysApart(least, now));
            }
        }
        EXPECT_LE(far, static_cast<int>(count) / 20);
        const auto before = [](const TouchSearch::Pair& p, const TouchSearch::Pair& q) {
            return p.a != q.a ? p.a < q.a : p.b < q.b;
        };
        EXPECT_TRUE(std::is_sorted(search.bodyPairs().begin(), search.bodyPairs().end(), before));
        EXPECT_TRUE(std::adjacent_find(search.bodyPairs().begin(), search.bodyPairs().end()) ==
                    search.bodyPairs().end());
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

TEST(TouchSearch, GridDoesNotMindWhereBodiesAre) {
    // Couples far from the rest, all in one column, and all far from the origin.
    const Strewn strewn(200);
    const auto pairsAt = [&](auto place) {
        std::vector<SweptBody> bodies = strewn.bodies;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            const Point by = place(i);
            for (Pose* pose : {&bodies[i].pose, &bodies[i].planned}) {
                pose->x += by.x;
                pose->y += by.y;
            }
        }
        TouchSearch search;
        search.find(bodies, strewn.obstacles);
        std::set<std::pair<std::uint32_t, std::uint32_t>> near;
        for (std::uint32_t a = 0; a < bodies.size(); ++a)
            for (std::uint32_t b = a + 1; b < bodies.size(); ++b)
                if (exactDistance(bodies[a], bodies[b]) <= bodies[a].travel + bodies[b].travel) near.insert({a, b});
        EXPECT_GT(near.size(), 5u);
        for (const TouchSearch::Pair& pair : search.bodyPairs()) near.erase({pair.a, pair.b});
        EXPECT_EQ(near.size(), 0u);
    };
    pairsAt([](std::size_t i) { return i / 2 == 40 ? Point{5000, -3000} : i / 2 == 41 ? Point{-1e6, 2} : Point{}; });
    pairsAt([&](std::size_t i) {
        return Point{-strewn.bodies[i].pose.x, static_cast<double>(i) * 0.3 - strewn.bodies[i].pose.y};
    });
    pairsAt([](std::size_t) { return Point{1e6, 1e6}; });
}

TEST(TouchSearch, BodyFasterThanTheIndexLooksAtAllObstacles) {
    const RobotType square = squareRobot();
    const Environment environment = walledField(100, 100);
    const ObstacleIndex obstacles(environment, 0.5);
    const SweptBody fast = SweptBody::of(*square.shape, {50, 50, 0}, {110, 50, 0});
    TouchSearch search;
    search.find({&fast, 1}, obstacles);
    EXPECT_EQ(search.obstaclePairs().size(), 4u);
}

}  // namespace
}  // namespace mrose
