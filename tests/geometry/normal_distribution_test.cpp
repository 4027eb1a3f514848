#include "geometry/normal_distribution.h"

#include <cmath>

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(NormalDistribution, AgreesWithTheCLibrarysErrorFunction) {
    for (double x = -8; x <= 8; x += 0.0625) {
        const long double tail = 0.5L * std::erfc(static_cast<long double>(x) / std::sqrt(2.0L));
        const long double below = 0.5L * std::erfc(-static_cast<long double>(x) / std::sqrt(2.0L));
        EXPECT_NEAR(normalProbability(x) / static_cast<double>(below), 1, 1e-12) << x;
        EXPECT_NEAR(logNormalProbability(x), static_cast<double>(std::log(below)),
                    1e-12 * std::max(1.0, -static_cast<double>(std::log(below))))
            << x;
        const long double density = std::exp(-0.5L * x * x) / std::sqrt(2 * std::numbers::pi_v<long double>);
        EXPECT_NEAR(normalHazard(x) / static_cast<double>(density / tail), 1, 2e-13) << x;
        EXPECT_NEAR(normalDensity(x) / static_cast<double>(density), 1, 1e-14) << x;
    }
}

TEST(NormalDistribution, IsFiniteFarOut) {
    EXPECT_EQ(normalProbability(-60), 0);
    EXPECT_EQ(normalProbability(60), 1);
    EXPECT_NEAR(logNormalProbability(-60), -0.5 * 3600 - std::log(60 * std::sqrt(2 * std::numbers::pi)), 1e-3);
    EXPECT_EQ(logNormalProbability(60), 0);
    EXPECT_NEAR(normalHazard(60), 60 + 1.0 / 60, 1e-4);
    EXPECT_EQ(normalHazard(-60), 0);
}

TEST(NormalDistribution, LogarithmAndItsSlopeComeTogether) {
    for (double x = -37; x <= 12; x += 0.0625) {
        const long double below = 0.5L * std::erfc(-static_cast<long double>(x) / std::sqrt(2.0L));
        const long double above = 0.5L * std::erfc(static_cast<long double>(x) / std::sqrt(2.0L));
        const auto expected = static_cast<double>(x > 0 ? std::log1p(-above) : std::log(below));
        const auto [value, slope] = logProbabilityAndSlope(x);
        EXPECT_NEAR(value, expected, std::max(1e-14 * std::abs(expected), 4e-15)) << x;
        EXPECT_EQ(slope, normalHazard(-x));
    }
    EXPECT_EQ(logProbabilityAndSlope(60).value, 0);
    EXPECT_NEAR(logProbabilityAndSlope(-60).value, logNormalProbability(-60), 1e-9);
}

TEST(NormalDistribution, QuantileIsTheInverse) {
    for (double x = -8; x <= 5; x += 0.125) EXPECT_NEAR(normalQuantile(normalProbability(x)), x, 1e-9) << x;
    EXPECT_NEAR(normalQuantile(0.5), 0, 1e-15);
    EXPECT_EQ(normalQuantile(0), -std::numeric_limits<double>::infinity());
    EXPECT_EQ(normalQuantile(1), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(normalQuantile(-0.1)));
    EXPECT_TRUE(std::isnan(normalQuantile(std::nan(""))));
}

}  // namespace
}  // namespace mrose
