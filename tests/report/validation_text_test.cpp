#include "report/validation_text.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

ValidatedMeasure measureOf(bool yesNo, const char* unit) {
    ValidatedMeasure measure;
    measure.yesNo = yesNo;
    measure.unit = unit;
    return measure;
}

const ValidatedMeasure time = measureOf(false, "s"), share = measureOf(true, "");

TEST(ValidationText, AValueHasAsManyDecimalsAsItsIntervalLeaves) {
    EXPECT_EQ(measuredText(time, {14.512, 12.79, 16.22}), "14.5 s");
    EXPECT_EQ(intervalText(time, {14.512, 12.79, 16.22}), "12.8 to 16.2");
    EXPECT_EQ(differenceText(time, {0.3921, 0.2375, 0.5467}), "+0.39 s");
    EXPECT_EQ(measuredText(time, {0.02895, 0.02688, 0.03101}), "0.0290 s");
    EXPECT_EQ(measuredText(time, {180.4, 120.0, 240.8}), "180 s");
    EXPECT_EQ(measuredText(time, 16.9), "16.9 s") << "three figures without an interval";
    EXPECT_EQ(measuredText(time, 0), "0.00 s");
    EXPECT_EQ(measuredText(share, {0.9312, 0.92, 0.94}), "93.1 %");
    EXPECT_EQ(differenceText(share, {-0.0341, -0.05, -0.02}, "\u2212"), "\u22123.4 points");
}

TEST(ValidationText, OfAGainSaysBetterOrWorse) {
    EXPECT_EQ(gainText(time, {0.5, 0.156, 0.854}), "better by 0.50 s");
    EXPECT_EQ(gainText(time, {-0.5, -0.854, -0.156}), "worse by 0.50 s");
    EXPECT_EQ(gainText(time, {-0.5, -0.854, 0.156}), "no difference shown");
    EXPECT_EQ(gainWithIntervalText(time, {-0.5, -0.854, -0.156}), "worse by 0.50 s (0.16 to 0.85)") << "turned round";
    EXPECT_EQ(gainWithIntervalText(time, {-0.5, -0.854, 0.156}), "no difference shown (-0.50 s, -0.85 to 0.16)");
    EXPECT_EQ(gainWithIntervalText(time, {0.5, -0.156, 0.854}), "no difference shown (+0.50 s, -0.16 to 0.85)");
    EXPECT_EQ(gainWithIntervalText(share, {0, 0, 0}), "no difference shown (0.0 points, 0.0 to 0.0)");
    EXPECT_EQ(gainWithIntervalText(share, {-0.0001, -0.0004, 0.0002}), "no difference shown (0.0 points, 0.0 to 0.0)")
        << "after rounding, without -0.0";
    EXPECT_EQ(gainWithIntervalText(time, {-0.5, -0.996, -0.004}), "no difference shown (-0.50 s, -1.00 to 0.00)")
        << "of what reads as 0 nobody sees that it is not";
    EXPECT_EQ(gainText(time, {0.5, 0.0051, 0.9949}), "better by 0.50 s");
    EXPECT_EQ(gainText(time, {}), "not known");
}

}  // namespace
}  // namespace mrose
