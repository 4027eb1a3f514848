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

/// What Box2D does with corners first: in float, and those nearer than 0.25 mm are one.
struct InFloat {
    float x, y;
};
std::vector<InFloat> inFloat(const Polygon& corners) {
    std::vector<InFloat> points;
    for (const Point& p : corners) points.push_back({static_cast<float>(p.x * 10), static_cast<float>(p.y * 10)});
    return points;
}
float cross(const InFloat& o, const InFloat& a, const InFloat& b) {
    const float ax = a.x - o.x, ay = a.y - o.y, bx = b.x - o.x, by = b.y - o.y;
    return ax * by - ay * bx;
}

/// The solver wraps a string round the corners: from each, to the one that has all others to its left.
TEST(ContactCorners, FloatsTellAnyTwoApartAndAnyThreeTurnLeft) {
    int kept = 0, some = 0, none = 0;
    for (std::int64_t which = 0; which < 20'000; ++which) {
        const Polygon before = randomConvex(which), corners = contactCorners(before);
        if (corners.empty()) {
            ++none;
            continue;
        }
        (corners.size() == before.size() ? kept : some) += 1;
        ASSERT_GE(corners.size(), 3u);
        const auto points = inFloat(corners);
        const std::size_t n = points.size();
        float area = 0;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j) {
                const float dx = points[i].x - points[j].x, dy = points[i].y - points[j].y;
                ASSERT_GE(dx * dx + dy * dy, 0.0025F * 0.0025F) << which;
                for (std::size_t k = j + 1; k < n; ++k) {
                    ASSERT_GT(cross(points[i], points[j], points[k]), 0) << which;
                    ASSERT_GT(cross(points[j], points[k], points[i]), 0) << which;
                    ASSERT_GT(cross(points[k], points[i], points[j]), 0) << which;
                }
                if (i == 0 && j + 1 < n) area += cross(points[0], points[j], points[j + 1]) / 2;
            }
        ASSERT_GT(area, 1.2e-7F) << which;
    }
    EXPECT_GT(kept, 1000);
    EXPECT_GT(some, 1000);
    EXPECT_GT(none, 1000);
}

TEST(ContactCorners, WhatFloatsBearIsKeptAsItIs) {
    for (const double far : {0.0, 20.0}) {
        const Polygon box{{far, 0}, {far + 0.001, 0}, {far + 0.001, 0.001}, {far, 0.001}};
        EXPECT_EQ(contactCorners(box), box);
        const Polygon needle{{far, 0}, {far + 10, 0}, {far + 10, 0.0004}};
        EXPECT_EQ(contactCorners(needle), needle);
    }
}

TEST(ContactCorners, NearOnesAreOne) {
    EXPECT_EQ(contactCorners({{0, 0}, {1, 0}, {1, 1}, {0.9999, 1}}), (Polygon{{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_EQ(contactCorners({{0, 0}, {1, 0}, {1, 0.0002}}), Polygon{});
    // 0.4 mm apart, but 1 km away the solver's floats are 0.06 mm apart, and at 100 km 8 mm.
    EXPECT_EQ(contactCorners({{1000, 0}, {1001, 0}, {1001, 0.0004}}).size(), 3u);
    EXPECT_EQ(contactCorners({{1e5, 1e5}, {1e5 + 1, 1e5}, {1e5 + 1, 1e5 + 0.0004}}), Polygon{});
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
