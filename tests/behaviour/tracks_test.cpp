#include "behaviour/tracks.h"

#include <gtest/gtest.h>

#include "behaviour/small_field.h"
#include "support/units.h"

namespace mrose {
namespace {

TEST(Tracks, VelocityIsThatOfWhatMovesSteadily) {
    Tracks tracks{};
    const Point velocity{1.1, -0.4};
    Point known;
    for (int i = 0; i < 20; ++i) {
        const Nanoseconds seen = i * 100 * ms;
        tracks.begin(seen);
        known = tracks.take(Point{3, 1} + toSeconds(seen) * velocity, seen);
        if (i == 0) {
            EXPECT_EQ(known, Point{}) << "seen once";
        }
    }
    EXPECT_NEAR(known.x, velocity.x, 0.01);
    EXPECT_NEAR(known.y, velocity.y, 0.01);
    EXPECT_EQ(tracks.count, 1u);
}

TEST(Tracks, WhatStandsHasNoVelocityThoughItIsSeenRoughly) {
    Tracks tracks{};
    for (int i = 0; i < 500; ++i) {
        tracks.begin(i * 100 * ms);
        EXPECT_EQ(tracks.take({2 + draw(1, i, 0, -0.02, 0.02), draw(1, i, 1, -0.02, 0.02)}, i * 100 * ms), Point{});
    }
}

TEST(Tracks, ThoseThatPassEachOtherKeepTheirWays) {
    Tracks tracks{};
    for (int i = 0; i < 30; ++i) {
        const Nanoseconds seen = i * 100 * ms;
        const double x = -1.5 + 0.1 * i;
        tracks.begin(seen);
        const Point right = tracks.take({x, 0.3}, seen), left = tracks.take({-x, -0.3}, seen);
        if (i < 10) continue;
        EXPECT_NEAR(right.x, 1, 0.1) << i;
        EXPECT_NEAR(left.x, -1, 0.1) << i;
    }
    EXPECT_EQ(tracks.count, 2u);
}

TEST(Tracks, WhatIsNotSeenForHalfASecondIsForgotten) {
    Tracks tracks{};
    tracks.begin(0);
    for (int i = 0; i < 20; ++i) tracks.take({2.0 * i, 0}, 0);
    EXPECT_EQ(tracks.count, Tracks::most);
    tracks.begin(500 * ms);
    EXPECT_EQ(tracks.count, Tracks::most);
    tracks.begin(501 * ms);
    EXPECT_EQ(tracks.count, 0u);
}

}  // namespace
}  // namespace mrose
