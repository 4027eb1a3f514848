#include "geometry/direction.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

using std::numbers::pi;

TEST(Direction, IsTheArcTangentAllRound) {
    for (int i = 0; i < 200000; ++i) {
        const double angle = -pi + 2 * pi * (i + 0.5) / 200000, far = std::exp((i % 41) - 20);
        const Point p{far * std::cos(angle), far * std::sin(angle)};
        ASSERT_NEAR(direction(p), std::atan2(p.y, p.x), 1e-15 * std::max(1.0, std::abs(angle))) << angle;
    }
}

TEST(Direction, AxesAndDiagonals) {
    EXPECT_EQ(direction({2, 0}), 0);
    EXPECT_EQ(direction({0, 3}), pi / 2);
    EXPECT_EQ(direction({0, -3}), -pi / 2);
    EXPECT_EQ(direction({-1, 0}), pi);
    EXPECT_EQ(direction({-1, -0.0}), pi);
    EXPECT_NEAR(direction({-5, -5}), -3 * pi / 4, 1e-15);
    EXPECT_EQ(direction({0, 0}), 0);
    EXPECT_NEAR(direction({1, 1e-300}), 1e-300, 1e-314);
}

}  // namespace
}  // namespace mrose
