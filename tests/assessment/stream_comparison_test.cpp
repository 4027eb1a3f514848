#include "assessment/stream_comparison.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

SensorPair somePair(double range) { return {"camera", {nullptr}, {range, 1.2, 0}}; }

SensedSubject subjectAt(double range, double bearing, bool reported, double rangeError = 0, double bearingError = 0) {
    return {0, range, bearing, true, reported, rangeError, bearingError};
}

/// One rollout from the session's beginning.
std::vector<RolloutRequest> oneRollout() { return {{0, 0, 10000}}; }

TEST(StreamComparison, SharesAreCountedByRangeAndBearing) {
    LookStreams looks;
    looks.real.push_back({0, 0, 1 * second, {subjectAt(0.4, 0.55, true), subjectAt(2.5, -0.55, false)}});
    looks.real.push_back({0, 0, 2 * second, {subjectAt(0.6, 0.55, false)}});
    looks.real.push_back({0, 0, 11 * second, {subjectAt(2.9, -0.55, true), subjectAt(2.1, 0, true)}});
    looks.real.push_back({0, 0, 12 * second, {}});
    looks.simulated.push_back({0, 0, 3 * second, {subjectAt(1.2, 0.05, true)}});
    const ComparedSensor compared = compareStreams(somePair(3), looks, oneRollout());
    const StreamFigures& all = compared.all;
    EXPECT_EQ(all.blocks, 2u);
    EXPECT_EQ(all.looks.real, 4u);
    EXPECT_EQ(all.looks.simulated, 1u);
    EXPECT_DOUBLE_EQ(all.reported.real.share, 0.6);
    EXPECT_DOUBLE_EQ(all.empty.real.share, 0.5);
    EXPECT_DOUBLE_EQ(all.empty.simulated.share, 0);
    EXPECT_FALSE(compared.robots[0]) << "it has no such sensor";

    std::size_t inBins = 0;
    for (const ShareBin& bin : all.byRange) {
        inBins += bin.reported.real.of;
        EXPECT_NEAR(bin.to - bin.from, 0.5, 1e-12);
    }
    EXPECT_EQ(inBins, 5u);
    ASSERT_EQ(all.byRange.size(), 6u);
    EXPECT_EQ(all.byRange[0].reported.real.share, 1);
    EXPECT_EQ(all.byRange[1].reported.real.share, 0);
    EXPECT_TRUE(std::isnan(all.byRange[2].reported.real.share));
    EXPECT_EQ(all.byRange[2].reported.simulated.share, 1);
    EXPECT_EQ(all.byRange[5].reported.real.share, 0.5);

    ASSERT_EQ(all.byBearing.size(), 12u);
    EXPECT_EQ(all.byBearing.front().reported.real.of, 2u);
    EXPECT_DOUBLE_EQ(all.byBearing.front().from, -0.6);
    EXPECT_EQ(all.byBearing.back().reported.real.of, 2u);
    EXPECT_DOUBLE_EQ(all.byBearing.back().to, 0.6);
}

TEST(StreamComparison, ErrorsAreThoseOfWhatWasReported) {
    LookStreams looks;
    looks.real.push_back({0, 0, 1 * second, {subjectAt(1, 0, true, 0.1, -0.02), subjectAt(1, 0, false, 9, 9)}});
    looks.real.push_back({0, 0, 2 * second, {subjectAt(1, 0, true, 0.3, 0.04)}});
    const StreamFigures figures = compareStreams(somePair(3), looks, oneRollout()).all;
    EXPECT_EQ(figures.range.of.real.distribution.count, 2u);
    EXPECT_DOUBLE_EQ(figures.range.of.real.distribution.mean, 0.2);
    EXPECT_DOUBLE_EQ(figures.range.of.real.deviation, std::sqrt(0.02));
    EXPECT_DOUBLE_EQ(figures.bearing.of.real.distribution.median, 0.01);
    EXPECT_EQ(figures.range.of.simulated.distribution.count, 0u);
    EXPECT_TRUE(std::isnan(figures.range.of.simulated.deviation));
    EXPECT_TRUE(std::isnan(figures.range.test.p));
}

TEST(StreamComparison, WhatIsReportedBeyondTheViewHasErrorsAndNoShare) {
    LookStreams looks;
    looks.real.push_back({0, 0, 0, {{0, 4, 0, false, true, 0.5, 0}}});
    const StreamFigures figures = compareStreams(somePair(3), looks, oneRollout()).all;
    EXPECT_EQ(figures.reported.real.of, 0u);
    EXPECT_EQ(figures.empty.real.share, 0);
    EXPECT_EQ(figures.range.of.real.distribution.count, 1u);
}

/// Looks of 200 s, whose errors have a part that lasts for their stretch.
LookStreams streams(std::uint64_t seed, double simulatedChance, double simulatedOffset) {
    LookStreams looks;
    for (std::uint32_t stream = 0; stream < 2; ++stream)
        for (int i = 0; i < 400; ++i) {
            const auto key = [&](std::int64_t tick, std::uint32_t draw) { return NoiseKey{seed, tick, stream, draw}; };
            const double lasting = normalNoise(key(i / 20, 0));
            const bool reported = uniformNoise(key(i, 1)) < (stream == 1 ? simulatedChance : 0.6);
            const NoisePair noise = normalPair(key(i, 2));
            const double offset = stream == 1 ? simulatedOffset : 0;
            (stream == 1 ? looks.simulated : looks.real)
                .push_back({0,
                            0,
                            i * second / 2,
                            {subjectAt(2, 0.1, reported, 0.05 * (lasting + noise.first) + offset,
                                       0.01 * (lasting + noise.second))}});
        }
    return looks;
}

TEST(StreamComparison, AlikeStreamsAreSeldomRejectedAndOthersAre) {
    constexpr int seeds = 200;
    int shares = 0, empties = 0, ranges = 0, bearings = 0, planted = 0, shifted = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const StreamFigures alike = compareStreams(somePair(3), streams(seed, 0.6, 0), oneRollout()).all;
        EXPECT_EQ(alike.blocks, 20u);
        shares += alike.reportedTest.p <= 0.05;
        empties += alike.emptyTest.p <= 0.05;
        ranges += alike.range.test.p <= 0.05;
        bearings += alike.bearing.test.p <= 0.05;
        if (seed > 20) continue;
        const StreamFigures other = compareStreams(somePair(3), streams(seed, 0.4, 0.1), oneRollout()).all;
        planted += other.reportedTest.p <= 0.05;
        shifted += other.range.test.p <= 0.05;
    }
    const double most = seeds * 0.05 + 3.5 * std::sqrt(seeds * 0.05 * 0.95);
    for (const int rejected : {shares, empties, ranges, bearings}) {
        EXPECT_LE(rejected, most);
        EXPECT_GE(rejected, 1);
    }
    EXPECT_GE(planted, 19);
    EXPECT_GE(shifted, 18);
}

TEST(StreamComparison, RolloutsOfOneStretchAreOneBlock) {
    LookStreams looks;
    const std::vector<RolloutRequest> requests{{0, 4 * second, 30}, {0, 7 * second, 30}, {1, 7 * second, 30}};
    for (std::size_t request = 0; request < 3; ++request)
        looks.real.push_back({request, 0, second, {subjectAt(1, 0, true)}});
    EXPECT_EQ(compareStreams(somePair(3), looks, requests).all.blocks, 2u) << "and of another session another";
}

}  // namespace
}  // namespace mrose
