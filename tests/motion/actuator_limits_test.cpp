#include "motion/actuator_limits.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(ActuatorLimits, EachWheelDoesWhatItCan) {
    ActuatorLimits limits;
    limits.wheelSpeed = 0.5;
    limits.halfTrack = 0.2;
    EXPECT_EQ(limits.withinWheelSpeed({0.4, 0.5}), (Command{0.4, 0.5}));  // 0.3 and 0.5 m/s
    const Command bend = limits.withinWheelSpeed({0.4, 1});               // 0.2 and 0.6
    EXPECT_DOUBLE_EQ(bend.v, 0.35);
    EXPECT_DOUBLE_EQ(bend.w, 0.75);
    const Command back = limits.withinWheelSpeed({-0.7, 0});
    EXPECT_DOUBLE_EQ(back.v, -0.5);
    EXPECT_DOUBLE_EQ(back.w, 0);
    const Command spin = limits.withinWheelSpeed({0, -5});
    EXPECT_DOUBLE_EQ(spin.v, 0);
    EXPECT_DOUBLE_EQ(spin.w, -2.5);
}

TEST(ActuatorLimits, NoneLeavesEveryCommand) {
    EXPECT_EQ(ActuatorLimits{}.withinWheelSpeed({30, -70}), (Command{30, -70}));
    EXPECT_FALSE(ActuatorLimits{}.ramps());
}

TEST(ActuatorLimits, AreToldInWordsAsFarAsThereAreAny) {
    EXPECT_EQ(limitsInWords({}), "");
    EXPECT_EQ(limitsInWords({0.5, 5.236, 0.498, 0.165}), "0.50 m/s² and 5.2 rad/s², wheels 0.50 m/s, 0.33 m apart");
    EXPECT_EQ(limitsInWords({0, 2, 0, 0}), "2.0 rad/s²");
    EXPECT_EQ(limitsInWords({0, 0, 0.45, 0.2}), "wheels 0.45 m/s, 0.40 m apart");
}

}  // namespace
}  // namespace mrose
