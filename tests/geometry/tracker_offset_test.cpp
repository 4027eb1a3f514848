#include "geometry/tracker_offset.h"

#include <vector>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

/// How a marker moves that lies so on a body, which goes forward and turns.
Pose markerIncrement(const TrackerOffset& offset, double forward, double turn) {
    const Pose marker{offset.ahead, 0, offset.rotated};
    return inverse(marker) * exp({forward, 0, turn}) * marker;
}

TEST(TrackerEvidence, FindsHowAMarkerLies) {
    const TrackerOffset real{-0.03, 0.02};
    TrackerEvidence evidence;
    EXPECT_TRUE(evidence.none());
    for (int i = 0; i < 100; ++i) {
        const auto draw = normalPair({1, i, 0, 0});
        evidence.add(markerIncrement(real, 0.01 + 0.005 * draw.first, 0.03 * draw.second));
    }
    EXPECT_FALSE(evidence.none());
    const TrackerOffset found = evidence.offset();
    EXPECT_NEAR(found.ahead, real.ahead, 1e-3);
    EXPECT_NEAR(found.rotated, real.rotated, 1e-3);
}

TEST(TrackerEvidence, WhatWasThoughtBeforeStaysWhereLittleWasSeen) {
    const TrackerOffset before{0.01, -0.3}, real{-0.05, 0.1};
    EXPECT_NEAR(TrackerEvidence{}.offset(before).ahead, before.ahead, 1e-9) << "nothing was seen";
    TrackerEvidence turns;
    turns.add(0.15, 0, 0.15 * real.ahead);
    EXPECT_NEAR(turns.offset(before).ahead, (before.ahead + real.ahead) / 2, 1e-6) << "as much was";
    EXPECT_NEAR(turns.offset(before).rotated, before.rotated, 1e-6) << "it never went forward";
    turns.add(0, 2, -2 * real.rotated);
    EXPECT_NEAR(turns.offset(before).rotated, real.rotated, 1e-3);
}

TEST(TrackerEvidence, ForgetsWhatFades) {
    TrackerEvidence evidence;
    evidence.add(1, 1, 0.3);
    evidence.fade(1e-4);
    evidence.add(1, 0, 0.02);
    evidence.add(0, 1, -0.05);
    EXPECT_NEAR(evidence.offset().ahead, 0.02, 1e-4);
    EXPECT_NEAR(evidence.offset().rotated, 0.05, 1e-4);
}

}  // namespace
}  // namespace mrose
