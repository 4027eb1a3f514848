// What a horizon closes, against angles: close() closes no direction outside of the arc, and all but its two outermost
// slots within it. Corner cases: arcs through straight against x, of less than a slot, of a whole turn and of nothing.
#include "sensing/horizon.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/elementary.h"
#include "world/noise.h"

namespace mrose {
namespace {

using std::numbers::pi;
constexpr double widestSlot = 2 * 4.0 / Horizon::slotCount;  // rad: turns grow by half an angle at least

double turnOf(double angle) { return Horizon::turnOf(towards(angle)); }

TEST(Horizon, TurnsGrowWithAngles) {
    EXPECT_EQ(Horizon::turnOf({1, 0}), 0);
    EXPECT_EQ(Horizon::turnOf({0, 3}), 1);
    EXPECT_EQ(Horizon::turnOf({0, -2}), -1);
    EXPECT_EQ(Horizon::turnOf({-1, 0}), 2);
    EXPECT_EQ(Horizon::turnOf({0, 0}), 0);
    for (double angle = -3.14; angle < 3.13; angle += 0.01) {
        const double grows = turnOf(angle + 0.01) - turnOf(angle);
        EXPECT_TRUE(grows >= 0.00499 && grows <= 0.01001) << angle;
    }
}

TEST(Horizon, ClosesWhatIsWithinAnArc) {
    Horizon horizon;
    for (std::int64_t i = 0; i < 400; ++i) {
        const auto draw = [&](std::uint32_t channel) { return uniformNoise({1, i, 0, channel}); };
        const double right = 2 * pi * draw(0) - pi, width = (i % 3 == 0 ? 6.2 : 0.05) * draw(1);
        const double left = right + width > pi ? right + width - 2 * pi : right + width;
        horizon.open();
        horizon.close({turnOf(right), turnOf(left)});
        for (std::uint32_t k = 0; k < 400; ++k) {
            const double from = -0.2 + (width + 0.4) * k / 400, angle = right + from;
            if (width + 0.4 > 2 * pi && (from < 0 || from > width)) continue;
            const bool closed = horizon.isClosed(Horizon::turnOf(towards(angle)));
            const bool outside = from < 0 || from > width, within = from > widestSlot && from < width - widestSlot;
            EXPECT_FALSE(outside && closed) << i << ' ' << from;
            EXPECT_TRUE(closed || !within) << i << ' ' << from;
        }
        if (width <= 3 * widestSlot) continue;
        const auto arc = [&](double shift, double wide) {
            return Horizon::Arc{turnOf(right + shift), turnOf(right + shift + wide)};
        };
        EXPECT_TRUE(horizon.isClosed(arc(1.1 * widestSlot, width - 2.2 * widestSlot)));
        EXPECT_FALSE(horizon.isClosed(arc(-1.1 * widestSlot, width)));
        EXPECT_FALSE(horizon.isClosed(arc(0.1 * widestSlot, width + widestSlot)));
    }
}

TEST(Horizon, OfNothingAndOfAll) {
    Horizon horizon;
    horizon.close({0, 0});
    horizon.close({1.99999, -1.99999});
    for (std::size_t slot = 0; slot < Horizon::slotCount; ++slot)
        EXPECT_FALSE(horizon.isClosed((slot + 0.5) * 4 / Horizon::slotCount - 2));
    horizon.close({1.5, -1.5});
    EXPECT_TRUE(horizon.isClosed(2));
    EXPECT_TRUE(horizon.isClosed(-2));
    EXPECT_TRUE(horizon.isClosed({1.6, -1.6}));
    EXPECT_FALSE(horizon.isClosed({1.4, -1.6}));
    EXPECT_FALSE(horizon.isClosed(Horizon::Arc{}));
    horizon.close({-2, 2});
    EXPECT_TRUE(horizon.isClosed(Horizon::Arc{}));
    EXPECT_TRUE(horizon.isClosed({1.4, -1.6}));
    horizon.open();
    EXPECT_FALSE(horizon.isClosed(2));
}

}  // namespace
}  // namespace mrose
