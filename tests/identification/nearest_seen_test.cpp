// From where on a sensor sees, of cases whose shares of reports are planted.
#include "identification/nearest_seen.h"

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

/// Subjects from 0.5 m to 6 m, of which so many nearer than `edge` are reported, and 40 % beyond.
SensorSamples samplesOf(int count, double edge, double near) {
    SensorSamples samples;
    for (int i = 0; i < count; ++i) {
        samples.looks.push_back({.robot = 0, .first = samples.cases.size(), .count = 1});
        SensorCase one;
        one.state.range = 0.5 + 5.5 * uniformNoise({1, i, 0, 0});
        one.state.bearing = 0.5 * uniformNoise({1, i, 1, 0});
        one.reported = uniformNoise({1, i, 2, 0}) < (one.state.range < edge ? near : 0.4);
        samples.cases.push_back(one);
    }
    return samples;
}

const View ahead{6, 1.2};

TEST(NearestSeen, IsWhereReportsBegin) {
    EXPECT_NEAR(nearestSeen(samplesOf(4000, 0.8, 0.02), ahead), 0.8, 0.02);
    EXPECT_NEAR(nearestSeen(samplesOf(4000, 0.9, 0), ahead), 0.9, 0.02);
}

TEST(NearestSeen, OfASensorThatSeesAllThatIsNearIsNone) {
    for (const double near : {0.4, 0.25, 0.9}) EXPECT_EQ(nearestSeen(samplesOf(4000, 0.8, near), ahead), 0) << near;
    EXPECT_EQ(nearestSeen({}, ahead), 0);
}

TEST(NearestSeen, IsNotSaidOfTooFew) { EXPECT_EQ(nearestSeen(samplesOf(250, 0.8, 0), ahead), 0); }

TEST(NearestSeen, WhatIsHiddenOrAsideOrSaidTwiceDoesNotCount) {
    SensorSamples samples = samplesOf(4000, 0, 0);
    for (std::size_t i = 0; i < 200; ++i) {
        const bool twice = i % 3 == 0;
        samples.looks.push_back({.robot = 0, .first = samples.cases.size(), .count = 1, .unknown = twice});
        SensorCase one;
        one.state.range = 0.6;
        if (i % 3 == 1) one.state.clearance = -0.1;
        if (i % 3 == 2) one.state.bearing = 1;
        samples.cases.push_back(one);
    }
    EXPECT_EQ(nearestSeen(samples, ahead), 0);
}

}  // namespace
}  // namespace mrose
