#include "geometry/angle.h"

#include <random>

#include <gtest/gtest.h>

#include "geometry/pose.h"

namespace mrose {
namespace {

using std::numbers::pi;

double above(double x) { return std::nextafter(x, 1e9); }
double below(double x) { return std::nextafter(x, -1e9); }

TEST(Angles, UpToTwoAndAHalfTurnsBothWaysToWrapThemAreTheSame) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> any(-5 * pi, 5 * pi);
    for (int i = 0; i < 200'000; ++i) {
        const double angle = any(random);
        ASSERT_EQ(wrapAngleNearly(angle), wrapAngle(angle)) << angle;
    }
    for (const double half : {-4, -3, -2, -1, 0, 1, 2, 3, 4})
        for (const double angle : {half * pi, above(half * pi), below(half * pi), above(above(half * pi))})
            EXPECT_EQ(wrapAngleNearly(angle), wrapAngle(angle)) << half;
}

TEST(Angles, BeyondTheyDifferByTheRoundingOfTheAngleItself) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> any(-2000, 2000);
    bool differ = false;
    for (int i = 0; i < 200'000; ++i) {
        const double angle = any(random), exactly = wrapAngle(angle), nearly = wrapAngleNearly(angle);
        const double most = (std::abs(angle) + pi) * 0x1p-53;
        ASSERT_LE(std::abs(nearly), pi + most);
        ASSERT_LE(std::abs(wrapAngle(nearly - exactly)), most + 0x1p-51) << angle;
        differ = differ || nearly != exactly;
    }
    EXPECT_TRUE(differ);
}

TEST(Angles, BetweenDirectionsTheyAreAtMostAHalfTurn) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-pi, pi);
    for (int i = 0; i < 200'000; ++i) {
        const double a = any(random), b = any(random);
        ASSERT_EQ(angleBetween(a, b), std::abs(wrapAngle(a - b))) << a << ' ' << b;
    }
    EXPECT_EQ(angleBetween(pi, -0.5 * pi), 0.5 * pi);
    EXPECT_EQ(angleBetween(-0.5 * pi, 0.5 * pi), pi);
    EXPECT_EQ(angleBetween(0.25, 0.25), 0);
}

}  // namespace
}  // namespace mrose
