#include "geometry/contact_corners.h"

#include <numbers>

#include <gtest/gtest.h>

#include "geometry/shape.h"
#include "world/noise.h"

namespace mrose {
namespace {

double random(std::int64_t which, std::uint32_t channel, double least, double most) {
    return least + (most - least) * uniformNoise({23, which, 0, channel});
}

/// Corners of a convex polygon, some of them close together, some nearly in line.
Polygon randomConvex(std::int64_t which) {
    const double reach = std::pow(10, random(which, 0, -3.5, 3)), flatter = std::pow(10, random(which, 1, -6, 0));
    const Placement placement(Pose{random(which, 2, -1000, 1000) * std::round(random(which, 3, 0, 1)),
                                   random(which, 4, -1000, 1000) * std::round(random(which, 5, 0, 1)),
                                   random(which, 6, -3, 3)});
    const auto corners = static_cast<std::uint32_t>(random(which, 7, 3, 9));
    double angle = 0;
    Polygon polygon;
    for (std::uint32_t i = 0; i < corners; ++i) {
        angle += std::pow(10, random(which, 8 + i, -6, 0)) * 2 * std::numbers::pi / corners;
        polygon.push_back(placement.place({reach * std::cos(angle), flatter * reach * std::sin(angle)}));
    }
    return polygon;
}

long double cross(const Point& o, const Point& a, const Point& b) {
    return (static_cast<long double>(a.x) - o.x) * (static_cast<long double>(b.y) - o.y) -
           (static_cast<long double>(a.y) - o.y) * (static_cast<long double>(b.x) - o.x);
}

TEST(ContactCorners, AnyTwoAreApartAndAnyThreeTurnLeft) {
    int kept = 0, some = 0, none = 0;
    for (std::int64_t which = 0; which < 20'000; ++which) {
        const Polygon before = randomConvex(which), corners = contactCorners(before);
        if (corners.empty()) {
            ++none;
            continue;
        }
        (corners.size() == before.size() ? kept : some) += 1;
        const std::size_t n = corners.size();
        ASSERT_GE(n, 3u);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j) {
                ASSERT_GT(distance(corners[i], corners[j]), 0.000299) << which;
                for (std::size_t k = j + 1; k < n; ++k)
                    ASSERT_GT(cross(corners[i], corners[j], corners[k]), 0.99e-5 * 0.000299) << which;
            }
        // Edges see all corners behind them, wherever the piece lies.
        const auto piece = ConvexPiece::polygon(corners);
        ASSERT_TRUE(piece) << which;
        for (std::size_t edge = 0; edge < piece->count; ++edge)
            for (const Point& p : corners)
                ASSERT_LE(dot(piece->normals[edge], p - piece->corners[edge]), 1e-9) << which;
    }
    EXPECT_GT(kept, 1000);
    EXPECT_GT(some, 1000);
    EXPECT_GT(none, 1000);
}

TEST(ContactCorners, WhatIsLargeEnoughIsKeptAsItIs) {
    for (const double far : {0.0, 20.0, 1e5}) {
        const Polygon box{{far, 0}, {far + 0.001, 0}, {far + 0.001, 0.001}, {far, 0.001}};
        EXPECT_EQ(contactCorners(box), box);
        const Polygon needle{{far, 0}, {far + 10, 0}, {far + 10, 0.0004}};
        EXPECT_EQ(contactCorners(needle), needle);
    }
}

TEST(ContactCorners, NearOnesAreOne) {
    EXPECT_EQ(contactCorners({{0, 0}, {1, 0}, {1, 1}, {0.9999, 1}}), (Polygon{{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_EQ(contactCorners({{0, 0}, {1, 0}, {1, 0.0002}}), Polygon{});
    // So they are however far away.
    EXPECT_EQ(contactCorners({{1e5, 1e5}, {1e5 + 1, 1e5}, {1e5 + 1, 1e5 + 0.0004}}).size(), 3u);
    EXPECT_EQ(contactCorners({{1e5, 1e5}, {1e5 + 1, 1e5}, {1e5 + 1, 1e5 + 0.0002}}), Polygon{});
    // A needle of 2 km, which is 1 mm wide at its end.
    EXPECT_EQ(contactCorners({{-1000, 0}, {1000, 0}, {1000, 0.001}}), Polygon{});
}

TEST(ConvexPiece, WithoutCornersThereIsNone) {
    EXPECT_FALSE(ConvexPiece::polygon({}));
    EXPECT_FALSE(ConvexPiece::polygon({{0, 0}, {1, 0}, {0.5, 1e-6}}));
    EXPECT_FALSE(ConvexPiece::polygon({{0, 0}, {0.0002, 0}, {0.0001, 0.0002}}));
    // Clockwise.
    EXPECT_FALSE(ConvexPiece::polygon({{0, 0}, {0, 1}, {1, 0}}));
    const Shape lost = Shape::fromParts("lost", {{"", {{0, 0}, {1, 0}, {1, 1e-6}}}});
    EXPECT_TRUE(lost.pieces.empty() && lost.partOfPiece.empty());
}

}  // namespace
}  // namespace mrose
