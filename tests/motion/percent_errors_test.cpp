#include "motion/percent_errors.h"

#include <cmath>

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(PercentErrors, WindowsThatGoFarCountForMore) {
    ErrorSums sums;
    sums.add(0.02, 0.1, 1, 0.5);  // 2 % of a metre
    sums.add(0.03, 0, 9, 0);      // a third of a percent of nine
    EXPECT_NEAR(sums.percentErrors().p, 0.5, 1e-12);
    EXPECT_NEAR(sums.percentErrors().hd, 20, 1e-12);
}

TEST(PercentErrors, AreNotDefinedWhereNothingDroveOrTurned) {
    EXPECT_TRUE(std::isnan(ErrorSums{}.percentErrors().p));
    ErrorSums turning;
    turning.add(0.01, 0.1, 0, 2);
    EXPECT_TRUE(std::isnan(turning.percentErrors().p));
    EXPECT_NEAR(turning.percentErrors().hd, 5, 1e-12);
}

}  // namespace
}  // namespace mrose
