#include "manipulation/learned_kicker.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/kolmogorov.h"
#include "support/planted_kicker.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

NoiseKey keyOf(std::int64_t tick) { return {4, tick, 2, channelOf(NoiseChannel::kick, 1)}; }

TEST(LearnedKicker, DrawsAreOfItsDistributions) {
    const LearnedKicker kicker(plantedKicker(0.7));
    const KickState state{0.8, {0.2, 0.4}, {0.37, 0.05}};
    const ReadingDistribution delay = kicker.delay(state), departure = kicker.departure(state);
    std::vector<double> delays, speeds, directions;
    double hits = 0;
    constexpr int draws = 4000;
    for (int i = 0; i < draws; ++i) {
        const KickDeparture drawn = kicker.drawDeparture(state, keyOf(i));
        delays.push_back(delay.probabilityBelow(0, toSeconds(kicker.drawDelay(state, keyOf(i)))));
        speeds.push_back(departure.probabilityBelow(0, drawn.speed));
        directions.push_back(departure.probabilityBelow(1, drawn.direction - 0.7));
        hits += drawn.hit ? 1.0 / draws : 0;
    }
    for (const auto& numbers : {delays, speeds, directions}) EXPECT_LT(kolmogorov(numbers), 1.63);
    EXPECT_NEAR(hits, departure.probability(), 0.025);
}

TEST(LearnedKicker, TheDelayDoesNotKnowWhereTheBallWillLie) {
    const LearnedKicker kicker(plantedKicker());
    const KickState here{0.8, {0.2, 0.4}, {0.37, 0.05}}, there{0.8, {0.2, 0.4}, {0.3, -0.1}};
    EXPECT_EQ(kicker.delay(here).mean(0), kicker.delay(there).mean(0));
    EXPECT_NE(kicker.departure(here).mean(0), kicker.departure(there).mean(0));
    EXPECT_NE(kicker.delay(here).mean(0), kicker.delay({0.3, {0.2, 0.4}, {}}).mean(0));
}

TEST(LearnedKicker, BeyondWhatWasSeenTheNearestCounts) {
    const LearnedKicker kicker(plantedKicker());
    EXPECT_EQ(kicker.departure({7, {3, 0}, {0.4, 0}}).mean(0), kicker.departure({1, {0.5, 0}, {0.4, 0}}).mean(0));
    EXPECT_TRUE(kicker.inReach({0.49, -0.19}));
    EXPECT_FALSE(kicker.inReach({0.51, 0}));
    EXPECT_FALSE(kicker.inReach({0.3, 0.21}));
}

TEST(KickNetworkFile, ComesBackToTheBit) {
    const KickNetwork network = plantedKicker(-1.2);
    const auto again = parseKick(kickText(network), "k.net");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(*again, network);
}

TEST(KickNetworkFile, WhatDoesNotFitIsRefused) {
    const std::string text = kickText(plantedKicker());
    const auto refused = [&](const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        const auto read = parseKick(std::string(text).replace(at, from.size(), to), "k.net");
        return read ? "no error" : read.error().message();
    };
    EXPECT_THAT(refused("kind = \"kick\"", "kind = \"sensor\""), testing::HasSubstr("another kind"));
    EXPECT_THAT(refused("\"robot_v\"", "\"robot_u\""), testing::HasSubstr("kick.seen: is of other inputs"));
    EXPECT_THAT(refused("components = 2", "components = 3"), testing::HasSubstr("kick.components: are described by"));
    EXPECT_THAT(refused("[0.0, 1.0]", "[1.0, 0.0]"), testing::HasSubstr("expected the least before the most"));
    EXPECT_THAT(refused("hits = 0.8", "hits = 1.8"), testing::HasSubstr("kick.constant.hits"));
    EXPECT_THAT(refused("direction_rad = ", "direction_deg = "), testing::HasSubstr("direction_rad"));
}

}  // namespace
}  // namespace mrose
