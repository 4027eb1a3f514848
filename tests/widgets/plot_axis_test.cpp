#include "widgets/plot_axis.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

PlotAxis axisOf(const PlotAxis::Time& time) {
    PlotAxis axis;
    axis.setTime(time);
    return axis;
}

TEST(PlotAxis, AllThatIsKnownStaysInViewAsItGrows) {
    PlotAxis axis = axisOf({.first = 0, .last = 100});
    for (std::int64_t last = 100; last < 5000; last += 37) {
        axis.setTime({.first = 0, .last = last, .now = last});
        EXPECT_EQ(axis.from(), 0);
        EXPECT_GE(axis.to(), last);
        EXPECT_TRUE(axis.showsAll());
    }
    axis.setTime({.first = 0, .last = 100, .end = 700});
    EXPECT_EQ(axis.to(), 700) << "what is awaited";
}

TEST(PlotAxis, ZoomKeepsWhatLiesAtItsPlace) {
    PlotAxis axis = axisOf({.first = 0, .last = 1000, .end = 1000});
    axis.zoom(4, 0.25);
    EXPECT_FALSE(axis.showsAll());
    EXPECT_DOUBLE_EQ(axis.to() - axis.from(), 250);
    EXPECT_DOUBLE_EQ(axis.from() + 0.25 * 250, 250);
    axis.zoom(1e9, 0.5);
    EXPECT_EQ(axis.to() - axis.from(), 10) << "no shorter";
    axis.showAll();
    EXPECT_EQ(axis.to(), 1000);
}

TEST(PlotAxis, PartGoesAlongWhenNowLeavesIt) {
    for (const std::int64_t now : {50, 150, 300, 900}) {
        PlotAxis axis = axisOf({.first = 0, .last = 1000});
        axis.show(100, 200);
        axis.setTime({.first = 0, .last = 1000, .now = now});
        EXPECT_DOUBLE_EQ(axis.to() - axis.from(), 100);
        EXPECT_LE(axis.from(), now);
        EXPECT_GE(axis.to(), now);
        EXPECT_EQ(axis.from() == 100, now == 150) << "only when it has left: " << now;
    }
}

TEST(PlotAxis, PansNoFartherThanHalfAViewBeforeTheFirstTick) {
    PlotAxis axis = axisOf({.first = 0, .last = 1000});
    axis.show(100, 200);
    axis.pan(0.5);
    EXPECT_EQ(axis.from(), 150);
    axis.pan(-10);
    EXPECT_EQ(axis.from(), -50);
    EXPECT_EQ(axis.to(), 50);
}

}  // namespace
}  // namespace mrose
