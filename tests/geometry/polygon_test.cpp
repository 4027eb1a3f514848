#include "geometry/polygon.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/shape.h"
#include "world/noise.h"

namespace mrose {
namespace {

using std::numbers::pi;

double draw(std::int64_t tick, std::uint32_t channel) { return uniformNoise({11, tick, 0, channel}); }

/// A star with `corners` corners at random distances round the origin: simple, mostly not convex.
Polygon randomStar(std::int64_t which, std::size_t corners) {
    Polygon polygon;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(corners);
        const double radius = 0.1 + 0.4 * draw(which, static_cast<std::uint32_t>(i));
        polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return polygon;
}

TEST(Polygon, AreaAndMomentsOfARectangle) {
    const Polygon rectangle{{1, 1}, {4, 1}, {4, 3}, {1, 3}};
    EXPECT_DOUBLE_EQ(signedArea(rectangle), 6);
    const AreaMoments moments = areaMoments(rectangle);
    EXPECT_DOUBLE_EQ(moments.area, 6);
    EXPECT_DOUBLE_EQ(moments.centroid.x, 2.5);
    EXPECT_DOUBLE_EQ(moments.centroid.y, 2);
    EXPECT_NEAR(moments.polar, 6 * (3.0 * 3 + 2 * 2) / 12, 1e-12);
    const Polygon clockwise(rectangle.rbegin(), rectangle.rend());
    EXPECT_DOUBLE_EQ(signedArea(clockwise), -6);
    EXPECT_NEAR(areaMoments(clockwise).polar, moments.polar, 1e-12);
}

TEST(Polygon, FindsEdgesThatCrossTouchOrFoldBack) {
    EXPECT_FALSE(selfIntersection(Polygon{{0, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}));
    EXPECT_TRUE(selfIntersection(Polygon{{0, 0}, {2, 2}, {2, 0}, {0, 2}}));          // a bow tie
    EXPECT_TRUE(selfIntersection(Polygon{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}));  // a corner on another edge
    EXPECT_TRUE(selfIntersection(Polygon{{0, 0}, {2, 0}, {1, 0}}));                  // flat
}

TEST(Polygon, ContainsByWindingAgreesWithTheConvexPieces) {
    for (std::int64_t which = 0; which < 50; ++which) {
        const Polygon star = randomStar(which, 5 + static_cast<std::size_t>(which) % 12);
        const std::vector<Polygon> pieces = convexPieces(star);
        for (std::uint32_t i = 0; i < 200; ++i) {
            const Point p{draw(which, 100 + 2 * i) - 0.5, draw(which, 101 + 2 * i) - 0.5};
            bool inPiece = false;
            for (const Polygon& piece : pieces) inPiece = inPiece || contains(piece, p);
            EXPECT_EQ(contains(star, p), inPiece) << which << ": " << p.x << ' ' << p.y;
        }
    }
}

TEST(Polygon, PiecesAreConvexSmallAndCoverTheSameAreaAndMoment) {
    for (std::int64_t which = 0; which < 300; ++which) {
        const Polygon star = randomStar(which, 4 + static_cast<std::size_t>(which) % 30);
        double area = 0, polar = 0;
        for (const Polygon& piece : convexPieces(star)) {
            EXPECT_LE(piece.size(), 8u);
            EXPECT_GE(piece.size(), 3u);
            const std::size_t n = piece.size();
            for (std::size_t i = 0; i < n; ++i)
                EXPECT_GE(cross(piece[(i + 1) % n] - piece[i], piece[(i + 2) % n] - piece[(i + 1) % n]), -1e-12);
            const AreaMoments m = areaMoments(piece);
            area += m.area;
            polar += m.polar + m.area * dot(m.centroid, m.centroid);
        }
        const AreaMoments whole = areaMoments(star);
        EXPECT_NEAR(area, whole.area, 1e-4 * whole.area) << which;
        EXPECT_NEAR(polar, whole.polar + whole.area * dot(whole.centroid, whole.centroid), 1e-3 * polar) << which;
    }
}

TEST(Polygon, ManyCornersOfACircleBecomeSeveralPieces) {
    Polygon round;
    for (int i = 0; i < 40; ++i) round.push_back({std::cos(2 * pi * i / 40), std::sin(2 * pi * i / 40)});
    const auto pieces = convexPieces(round);
    EXPECT_GE(pieces.size(), 38u / 6u);
    double area = 0;
    for (const Polygon& piece : pieces) area += areaMoments(piece).area;
    EXPECT_NEAR(area, signedArea(round), 1e-9);
}

TEST(Polygon, FlatCornersAreLeftOut) {
    const auto pieces = convexPieces(Polygon{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {0, 2}});
    ASSERT_EQ(pieces.size(), 1u);
    EXPECT_EQ(pieces[0].size(), 4u);
}

/// The distance of two convex pieces by the least of many sampled pairs of points of their outlines.
double sampledDistance(const ConvexPiece& a, const ConvexPiece& b) {
    constexpr int samples = 200;
    const auto outline = [](const ConvexPiece& piece, int i) -> Point {
        if (piece.isCircle()) {
            const double angle = 2 * pi * i / samples;
            return piece.centre + piece.radius * Point{std::cos(angle), std::sin(angle)};
        }
        const double along = static_cast<double>(i) / samples * static_cast<double>(piece.count);
        const auto edge = static_cast<std::size_t>(along);
        const double share = along - std::floor(along);
        return (1 - share) * piece.corners[edge] + share * piece.corners[(edge + 1) % piece.count];
    };
    double least = 1e9;
    for (int i = 0; i < samples; ++i)
        for (int j = 0; j < samples; ++j) least = std::min(least, distance(outline(a, i), outline(b, j)));
    return least;
}

TEST(ConvexPiece, DistanceAgreesWithSampledOutlines) {
    const std::vector<ConvexPiece> kinds{*ConvexPiece::polygon({{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}}),
                                         *ConvexPiece::polygon({{-0.1, -0.1}, {0.3, 0}, {-0.1, 0.1}}),
                                         ConvexPiece::circle({0.05, 0}, 0.15)};
    for (std::int64_t which = 0; which < 120; ++which) {
        const ConvexPiece& a = kinds[static_cast<std::size_t>(which) % 3];
        const Pose pose{draw(which, 0) - 0.5, draw(which, 1) - 0.5, 6 * draw(which, 2)};
        const ConvexPiece b = placed(kinds[static_cast<std::size_t>(which / 3) % 3], Placement(pose));
        const double d = distance(a, b);
        if (d > 0) {
            EXPECT_NEAR(d, sampledDistance(a, b), 0.004) << which;
            EXPECT_TRUE(nearer(a, b, d + 1e-9));
            EXPECT_FALSE(nearer(a, b, 0) && d > 0.2);
        } else {
            // Moved apart by the depth and a little more, they touch no longer in at least one direction.
            bool apart = false;
            for (int i = 0; i < 360 && !apart; ++i) {
                const double angle = 2 * pi * i / 360;
                const Pose by{(-d + 1e-3) * std::cos(angle), (-d + 1e-3) * std::sin(angle), 0};
                apart = distance(a, placed(b, Placement(by))) > 0;
            }
            EXPECT_TRUE(apart) << which;
        }
    }
}

TEST(ConvexPiece, NormalsStayOutwardWhenPlaced) {
    const ConvexPiece turned =
        placed(*ConvexPiece::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), Placement(Pose{2, 3, 0.7}));
    for (std::size_t i = 0; i < turned.count; ++i) {
        EXPECT_NEAR(length(turned.normals[i]), 1, 1e-12);
        EXPECT_NEAR(dot(turned.normals[i], turned.corners[(i + 1) % 4] - turned.corners[i]), 0, 1e-12);
        EXPECT_LT(dot(turned.normals[i], turned.centre - turned.corners[i]), 0);
    }
}

TEST(Shape, KnowsReachCentroidAndGyrationOfItsParts) {
    ShapePart square, disc;
    square.polygon = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    disc.centre = {-1, 1};
    disc.radius = 0.5;
    const Shape shape = Shape::fromParts("two", {square, disc});
    const double discArea = pi / 4, area = 4 + discArea;
    EXPECT_NEAR(shape.centroid.x, (4 * 1 - discArea) / area, 1e-12);
    EXPECT_NEAR(shape.centroid.y, 1, 1e-12);
    EXPECT_NEAR(shape.reach, std::sqrt(8.0), 1e-12);
    const double about = [&](double x, double ownPolar,
                             double a) { return ownPolar + a * (x - shape.centroid.x) * (x - shape.centroid.x); }(
                             1, 4 * (2.0 * 2 + 2 * 2) / 12, 4) +
                         (discArea * 0.125 + discArea * (-1 - shape.centroid.x) * (-1 - shape.centroid.x));
    EXPECT_NEAR(shape.gyration, std::sqrt(about / area), 1e-12);
    EXPECT_EQ(shape.pieces.size(), 2u);
    EXPECT_EQ(shape.partOfPiece, (std::vector<std::uint32_t>{0, 1}));
}

}  // namespace
}  // namespace mrose
