#include "motion/portable_math.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(PortableMath, SineOfTurnsAgreesWithTheLibrary) {
    for (int i = -40000; i <= 40000; ++i) {
        const double turns = i * 1.2345e-4;
        EXPECT_NEAR(sinTurns(turns), std::sin(2 * std::numbers::pi * turns), 3e-14) << turns;
        EXPECT_NEAR(cosTurns(turns), std::cos(2 * std::numbers::pi * turns), 3e-14) << turns;
    }
}

TEST(PortableMath, SineIsOddAndPeriodic) {
    EXPECT_EQ(sinTurns(0), 0);
    EXPECT_EQ(sinTurns(-0.3), -sinTurns(0.3));
    EXPECT_EQ(sinTurns(1048576.25), 1.0 * sinTurns(0.25));
}

TEST(PortableMath, DecayAgreesWithTheLibrary) {
    for (int i = 0; i <= 70000; ++i) {
        const double x = i * 0.01;
        EXPECT_NEAR(decay(x) / std::exp(-x), 1, 2e-13) << x;
    }
    EXPECT_EQ(decay(1000), 0);
}

}  // namespace
}  // namespace mrose
