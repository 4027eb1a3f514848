#include "tuning/search.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace mrose {
namespace {

using Points = std::vector<std::vector<double>>;

/// What is asked for until so many points are known; what they cost is the distance from (0.3, 0.8).
Points searched(std::size_t count, std::uint64_t seed) {
    Points points;
    searchUnitCube({0.5, 0.5}, {0.001, 0.001}, seed, [&](std::span<const double> point) -> std::optional<double> {
        if (points.size() == count) return std::nullopt;
        points.emplace_back(point.begin(), point.end());
        return std::hypot(point[0] - 0.3, point[1] - 0.8);
    });
    return points;
}

TEST(SearchTest, BeginsWithWhatIsNowAndAPointInEachTenthOfEachRange) {
    const Points points = searched(11, 1);
    ASSERT_EQ(points.size(), 11u);
    EXPECT_EQ(points[0], (std::vector<double>{0.5, 0.5}));
    for (std::size_t dimension = 0; dimension < 2; ++dimension) {
        std::set<int> tenths;
        for (std::size_t i = 1; i < points.size(); ++i) tenths.insert(static_cast<int>(10 * points[i][dimension]));
        EXPECT_EQ(tenths, (std::set<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
    }
}

TEST(SearchTest, StaysWithinTheCubeAndComesToTheMinimum) {
    double nearest = 1;
    for (const std::vector<double>& point : searched(100, 1)) {
        for (const double share : point) EXPECT_TRUE(share >= 0 && share <= 1) << share;
        nearest = std::min(nearest, std::hypot(point[0] - 0.3, point[1] - 0.8));
    }
    EXPECT_LT(nearest, 0.02);
}

TEST(SearchTest, GoesOnElsewhereWhenItHasArrived) {
    const Points points = searched(300, 1);
    const auto isFar = [](const std::vector<double>& point) {
        return std::hypot(point[0] - 0.3, point[1] - 0.8) > 0.3;
    };
    EXPECT_GE(std::count_if(points.end() - 150, points.end(), isFar), 3);
}

TEST(SearchTest, IsThatOfItsSeed) {
    EXPECT_EQ(searched(100, 1), searched(100, 1));
    EXPECT_NE(searched(100, 1), searched(100, 2));
}

}  // namespace
}  // namespace mrose
