#include "drawing/label_placement.h"

#include <vector>

#include <gtest/gtest.h>

namespace mrose {
namespace {

constexpr PageBox page{0, 0, 400, 300};

std::size_t covered(const PageBox& box, const std::vector<Point>& points) {
    std::size_t count = 0;
    for (const Point& point : points) count += box.holds(point);
    return count;
}

/// Points along a line through `at`, `length` pixels to both sides.
std::vector<Point> line(const Point& at, const Point& direction, double length) {
    std::vector<Point> points;
    for (double s = -length; s <= length; s += 2) points.push_back(at + s * direction);
    return points;
}

TEST(LabelPlacement, IsBesideThePointAndAsLargeAsTheLabel) {
    const PageBox box = placeLabel({200, 150}, 60, 14, {}, {}, page);
    EXPECT_NEAR(box.right - box.left, 60, 1e-9);
    EXPECT_NEAR(box.bottom - box.top, 14, 1e-9);
    EXPECT_FALSE(box.holds({200, 150}));
    EXPECT_LT(distance(box.centre(), {200, 150}), 45);
}

TEST(LabelPlacement, KeepsOffPathsInAnyDirection) {
    const Point at{200, 150};
    for (const Point& direction : {Point{1, 0}, Point{0, 1}, Point{0.6, 0.8}, Point{-0.8, 0.6}}) {
        const std::vector<Point> path = line(at, direction, 120);
        EXPECT_EQ(covered(placeLabel(at, 60, 14, path, {}, page), path), 0u) << direction.x << ' ' << direction.y;
    }
}

TEST(LabelPlacement, StaysOnThePage) {
    for (const Point& at : {Point{2, 2}, Point{398, 2}, Point{2, 298}, Point{398, 298}, Point{200, 2}}) {
        const PageBox box = placeLabel(at, 60, 14, {}, {}, page);
        EXPECT_GE(box.left, 0) << at.x << ' ' << at.y;
        EXPECT_GE(box.top, 0) << at.x << ' ' << at.y;
        EXPECT_LE(box.right, 400) << at.x << ' ' << at.y;
        EXPECT_LE(box.bottom, 300) << at.x << ' ' << at.y;
    }
}

TEST(LabelPlacement, KeepsOffOtherLabels) {
    std::vector<PageBox> taken;
    for (int i = 0; i < 5; ++i) {
        const PageBox box = placeLabel({200.0 + 3 * i, 150}, 60, 14, {}, taken, page);
        for (const PageBox& other : taken) EXPECT_FALSE(box.overlaps(other)) << i;
        taken.push_back(box);
    }
}

}  // namespace
}  // namespace mrose
