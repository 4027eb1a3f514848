#include "assessment/block_swaps.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

std::vector<BlockValue> samples(const std::vector<double>& real, const std::vector<double>& simulated) {
    std::vector<BlockValue> values;
    for (std::size_t i = 0; i < real.size(); ++i) values.push_back({real[i], static_cast<std::uint32_t>(i), false});
    for (std::size_t i = 0; i < simulated.size(); ++i)
        values.push_back({simulated[i], static_cast<std::uint32_t>(i), true});
    return values;
}

double distanceOf(const std::vector<double>& real, const std::vector<double>& simulated) {
    return testDistributions(samples(real, simulated)).statistic;
}

TEST(BlockSwaps, DistanceOfDistributionsIsThatOfKolmogorovAndSmirnov) {
    EXPECT_DOUBLE_EQ(distanceOf({1, 2, 3}, {4, 5, 6}), 1);
    EXPECT_DOUBLE_EQ(distanceOf({4, 5, 6}, {1, 2, 3}), 1);
    EXPECT_DOUBLE_EQ(distanceOf({3, 1}, {2, 4}), 0.5);
    EXPECT_DOUBLE_EQ(distanceOf({1, 2, 3}, {3, 2, 1}), 0) << "equal values count together";
    EXPECT_DOUBLE_EQ(distanceOf({1, 1, 2}, {1, 2}), 2.0 / 3 - 0.5);
    // a quarter, a half, three quarters of one are below any of the other's
    EXPECT_DOUBLE_EQ(distanceOf({1, 2, 3, 10}, {5, 6}), 0.75);
    EXPECT_TRUE(std::isnan(distanceOf({1, 2}, {})));
    EXPECT_TRUE(std::isnan(distanceOf({}, {})));
}

TEST(BlockSwaps, FewBlocksGiveNoProbability) {
    std::vector<double> real(leastBlocks - 1, 0), simulated(leastBlocks - 1, 1);
    EXPECT_TRUE(std::isnan(testDistributions(samples(real, simulated)).p));
    EXPECT_EQ(testDistributions(samples(real, simulated)).blocks, leastBlocks - 1);
    real.push_back(0), simulated.push_back(1);
    EXPECT_FALSE(std::isnan(testDistributions(samples(real, simulated)).p));
}

TEST(BlockSwaps, ProbabilityIsTheShareOfArrangementsThatAreAsLarge) {
    // Of n pairs of different values only the two arrangements that keep them all apart have a distance of 1: 2 of 2^n.
    const std::size_t n = 8;
    const TwoSampleTest apart = testDistributions(samples(std::vector<double>(n, 0), std::vector<double>(n, 1)));
    EXPECT_EQ(apart.statistic, 1);
    const double expected = std::pow(2, 1 - static_cast<double>(n));
    EXPECT_NEAR(apart.p, expected, 4 * std::sqrt(expected / blockSwaps) + 1.0 / blockSwaps);
    // Nothing is less alike than the same.
    const std::vector<double> same(n, 3);
    EXPECT_EQ(testDistributions(samples(same, same)).p, 1);
}

/// A stream of `blocks` blocks of `each` values, which share a part of their variance within a block.
void addStream(std::vector<BlockValue>& values, bool simulated, std::uint64_t seed, std::size_t blocks, int each,
               double common, double offset) {
    for (std::uint32_t block = 0; block < blocks; ++block) {
        const auto draw = [&](std::uint32_t n) { return normalNoise({seed, block, simulated ? 1u : 0u, n}); };
        const double shared = std::sqrt(common) * draw(0);
        for (int i = 1; i <= each; ++i)
            values.push_back(
                {offset + shared + std::sqrt(1 - common) * draw(static_cast<std::uint32_t>(i)), block, simulated});
    }
}

TwoSampleTest testOfStreams(std::uint64_t seed, double common, double offset) {
    std::vector<BlockValue> values;
    addStream(values, false, seed, 30, 25, common, 0);
    addStream(values, true, seed, 30, 25, common, offset);
    return testDistributions(values);
}

TEST(BlockSwaps, StreamsOfOneModelAreRejectedAsOftenAsPromised) {
    constexpr int seeds = 400;
    int below5 = 0, below50 = 0, naive = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const TwoSampleTest test = testOfStreams(seed, 0.5, 0);
        below5 += test.p <= 0.05;
        below50 += test.p <= 0.5;
        // As if all 750 and 750 values were independent: rejected at 5 % beyond 1.358 of Kolmogorov's distribution.
        naive += test.statistic * std::sqrt(750.0 / 2) > 1.358;
    }
    const auto within = [](double share) { return 3.5 * std::sqrt(share * (1 - share) / seeds); };
    EXPECT_NEAR(below5 / double(seeds), 0.05, within(0.05));
    EXPECT_NEAR(below50 / double(seeds), 0.5, within(0.5));
    EXPECT_GT(naive / double(seeds), 0.5) << "what the test is for";
}

TEST(BlockSwaps, DifferencesAreFound) {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) found += testOfStreams(seed, 0.1, 0.5).p <= 0.01;
    EXPECT_GE(found, 19);
}

TEST(BlockSwaps, SharesOfOneKindAreRejectedAsOftenAsPromised) {
    constexpr int seeds = 400;
    int below5 = 0, found = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        std::vector<BlockCounts> alike, other;
        for (std::uint32_t block = 0; block < 40; ++block) {
            // How much is reported in a block is a matter of the block, but by halves of its own.
            const auto reports = [&](std::uint32_t stream, double share) {
                return std::floor(20 * share * uniformNoise({seed, block, stream, 0}));
            };
            alike.push_back({20, reports(0, 1), 20, reports(1, 1)});
            other.push_back({20, reports(0, 1), 20, reports(1, 0.6)});
        }
        below5 += testShares(alike).p <= 0.05;
        found += testShares(other).p <= 0.05;
    }
    EXPECT_NEAR(below5 / double(seeds), 0.05, 3.5 * std::sqrt(0.05 * 0.95 / seeds));
    EXPECT_GT(found / double(seeds), 0.8);
}

TEST(BlockSwaps, SharesHaveTheErrorOfTheirBlocks) {
    // Shares of 1 and 0 in blocks of one size: as if there were but two values.
    const BlockSum two[] = {{10, 10}, {10, 0}};
    const BlockShare share = shareOf(two);
    EXPECT_EQ(share.of, 20u);
    EXPECT_DOUBLE_EQ(share.share, 0.5);
    EXPECT_DOUBLE_EQ(share.error, std::sqrt(0.5) / std::sqrt(2)) << "standard deviation of 0 and 1 over root 2";
    const BlockSum alike[] = {{10, 3}, {20, 6}, {0, 0}};
    EXPECT_DOUBLE_EQ(shareOf(alike).share, 0.3);
    EXPECT_NEAR(shareOf(alike).error, 0, 1e-12);
    const BlockSum one[] = {{10, 3}};
    EXPECT_DOUBLE_EQ(shareOf(one).share, 0.3);
    EXPECT_TRUE(std::isnan(shareOf(one).error)) << "of one block nothing is known";
    EXPECT_TRUE(std::isnan(shareOf({}).share));
}

}  // namespace
}  // namespace mrose
