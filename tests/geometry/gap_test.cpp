// How two convex pieces lie to each other, against all pairs of corners and edges.
#include "geometry/gap.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "geometry/polygon.h"

namespace mrose {
namespace {

double drawn(std::mt19937& random, double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
}

/// Of 3 to 8 corners on an ellipse, some thin as a needle; or a circle.
ConvexPiece randomPiece(std::mt19937& random, const Point& centre) {
    if (random() % 5 == 0) return ConvexPiece::circle(centre, drawn(random, 0.02, 0.3));
    const std::size_t corners = 3 + random() % 6;
    const double wide = drawn(random, 0.05, 0.3), high = random() % 4 == 0 ? 0.01 : drawn(random, 0.05, 0.3);
    const double turned = drawn(random, -3, 3), first = drawn(random, 0, 1);
    Polygon polygon;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 2 * 3.14159265358979 * (static_cast<double>(i) + first) / static_cast<double>(corners);
        const Point p{wide * std::cos(angle), high * std::sin(angle)};
        polygon.push_back(centre + Point{std::cos(turned) * p.x - std::sin(turned) * p.y,
                                         std::sin(turned) * p.x + std::cos(turned) * p.y});
    }
    return *ConvexPiece::polygon(polygon);
}

double nearestToEdges(const ConvexPiece& corners, const ConvexPiece& edges) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners.count; ++i)
        for (std::size_t k = 0; k < edges.count; ++k)
            least = std::min(
                least, distanceToSegment(corners.corners[i], edges.corners[k], edges.corners[edges.cornerAfter(k)]));
    return least;
}

/// The largest of the distances that the normals of `faces` separate the other by; of corners alone.
double separation(const ConvexPiece& faces, const ConvexPiece& other) {
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < faces.count && !faces.isCircle(); ++i) {
        const Point &start = faces.corners[i], &end = faces.corners[faces.cornerAfter(i)];
        const Point outward = (1 / length(end - start)) * Point{end.y - start.y, start.x - end.x};
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < other.count; ++k) least = std::min(least, dot(outward, other.corners[k] - start));
        most = std::max(most, least);
    }
    return most;
}

double bruteDistance(const ConvexPiece& a, const ConvexPiece& b) {
    const double radii = a.radius + b.radius;
    if (a.isCircle() && b.isCircle()) return length(a.corners[0] - b.corners[0]) - radii;
    const double separates = std::max(separation(a, b), separation(b, a));
    if (separates <= 0) return separates - radii;
    return std::min(nearestToEdges(a, b), nearestToEdges(b, a)) - radii;
}

TEST(Gap, IsTheLeastDistanceOfCornersAndEdgesOrTheLeastDepth) {
    std::mt19937 random(1);
    int overlapping = 0;
    for (int trial = 0; trial < 50'000; ++trial) {
        const ConvexPiece a = randomPiece(random, {});
        const ConvexPiece b = randomPiece(random, {drawn(random, -0.6, 0.6), drawn(random, -0.6, 0.6)});
        const double distance = bruteDistance(a, b);
        const Gap gap = gapBetween(a, b);
        ASSERT_NEAR(gap.distance, distance, 1e-9) << trial;
        ASSERT_NEAR(gapBetween(b, a).distance, distance, 1e-9) << trial;
        ASSERT_NEAR(length(gap.axis), 1, 1e-12) << trial;
        overlapping += distance < 0 ? 1 : 0;
    }
    EXPECT_GT(overlapping, 5000);
    EXPECT_LT(overlapping, 45'000);
}

/// Moved along the axis by the gap they touch; by more they are apart by that.
TEST(Gap, AxisLeadsFromTheFirstToTheSecond) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 20'000; ++trial) {
        const ConvexPiece a = randomPiece(random, {});
        const ConvexPiece b = randomPiece(random, {drawn(random, -0.6, 0.6), drawn(random, -0.6, 0.6)});
        const Gap gap = gapBetween(a, b);
        Placement moved;
        moved.origin = -gap.distance * gap.axis;
        ASSERT_NEAR(bruteDistance(a, placed(b, moved)), 0, 1e-5) << trial;
        moved.origin = (0.1 - gap.distance) * gap.axis;
        ASSERT_NEAR(bruteDistance(a, placed(b, moved)), 0.1, 1e-5) << trial;
    }
}

}  // namespace
}  // namespace mrose
