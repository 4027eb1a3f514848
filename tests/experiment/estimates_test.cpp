#include "experiment/estimates.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

TEST(Estimates, StudentQuantilesAreThoseOfTheTables) {
    EXPECT_NEAR(studentQuantile(1), std::tan(0.475 * std::numbers::pi), 1e-9) << "Cauchy's distribution";
    EXPECT_NEAR(studentQuantile(2), 0.95 * std::sqrt(2 / (1 - 0.95 * 0.95)), 1e-9) << "in closed form";
    const std::pair<std::size_t, double> published[] = {{3, 3.1824},  {4, 2.7764},  {5, 2.5706},  {10, 2.2281},
                                                        {30, 2.0423}, {60, 2.0003}, {120, 1.9799}};
    for (const auto& [degrees, quantile] : published) EXPECT_NEAR(studentQuantile(degrees), quantile, 6e-5) << degrees;
    EXPECT_NEAR(studentQuantile(1'000'000), 1.95996, 1e-5);
    EXPECT_NEAR(studentQuantile(10'000), studentQuantile(10'001), 3e-4) << "from where it counts as normal";
    EXPECT_TRUE(std::isinf(studentQuantile(0)));
}

TEST(Estimates, MeanHasStudentsInterval) {
    const std::vector<double> values{1, 2, 6};  // deviation sqrt(7)
    const Estimate mean = meanOf(values);
    EXPECT_NEAR(mean.value, 3, 1e-12);
    EXPECT_NEAR(mean.high - mean.value, 4.30265 * std::sqrt(7.0 / 3), 1e-4);
    EXPECT_NEAR(mean.value - mean.low, mean.high - mean.value, 1e-12);
    EXPECT_EQ(meanOf(std::vector<double>{5}).value, 5);
    EXPECT_TRUE(std::isnan(meanOf(std::vector<double>{5}).low));
    EXPECT_TRUE(std::isnan(meanOf({}).value));
}

/// Its ends are the shares from which the one that was seen is just 1.96 of their own deviations off.
TEST(Estimates, WilsonsIntervalIsSolvedForItsEnds) {
    for (const double count : {5.0, 40.0, 1000.0})
        for (const double share : {0.0, 0.2, 0.93, 1.0}) {
            const Estimate estimate = wilsonShare(share, count);
            for (const double end : {estimate.low, estimate.high})
                if (end > 0 && end < 1) {
                    EXPECT_NEAR(std::abs(end - share), 1.959964 * std::sqrt(end * (1 - end) / count), 1e-6);
                }
            EXPECT_LE(estimate.low, share + 1e-12);
            EXPECT_GE(estimate.high, share - 1e-12);
        }
    EXPECT_NEAR(wilsonShare(0, 10).high, 0.2775, 1e-4) << "published";
    EXPECT_TRUE(std::isnan(wilsonShare(0.5, 0).value));
}

TEST(Estimates, RunsThatAreAlikeCountAsFewer) {
    std::vector<double> together, apart;
    for (int i = 0; i < 200; ++i) {
        together.push_back(i % 2);  // all four seeds of a trial alike
        double sum = 0;
        for (std::uint32_t k = 0; k < 4; ++k) sum += uniformNoise({1, i, 0, k}) < 0.5 ? 0.25 : 0;
        apart.push_back(sum);
    }
    EXPECT_NEAR(effectiveCount(together, 800), 199, 1e-6);
    EXPECT_NEAR(effectiveCount(apart, 800), 800, 200);
    EXPECT_EQ(effectiveCount(together, 200), 200) << "one seed each";
}

/// Pairs whose means are in the ratio 0.8.
struct Pairs {
    std::vector<double> of, over;
    explicit Pairs(std::uint64_t seed, int count, double mean = 1) {
        for (int i = 0; i < count; ++i) {
            const NoisePair noise = normalPair({seed, i, 0, 0});
            over.push_back(mean + noise.first);
            of.push_back(0.8 * mean + 0.6 * noise.first + 0.5 * noise.second);
        }
    }
};

/// Fieller: the ratios r at which the mean of (a - r b) is just as far from 0 as its own interval reaches.
TEST(Estimates, RatiosIntervalIsWhereTheResidualIsJustNone) {
    const Pairs pairs(3, 60);
    const Estimate ratio = ratioOfMeans(pairs.of, pairs.over);
    for (const double end : {ratio.low, ratio.high}) {
        std::vector<double> residual;
        for (std::size_t i = 0; i < pairs.of.size(); ++i) residual.push_back(pairs.of[i] - end * pairs.over[i]);
        const Estimate mean = meanOf(residual);
        EXPECT_NEAR(std::min(std::abs(mean.low), std::abs(mean.high)), 0, 1e-9);
    }
    EXPECT_LT(ratio.low, ratio.value);
    EXPECT_GT(ratio.high, ratio.value);
}

TEST(Estimates, IntervalsHoldTheTruthIn95Of100) {
    int means = 0, ratios = 0;
    constexpr int times = 2000;
    for (int i = 0; i < times; ++i) {
        const Pairs pairs(100 + static_cast<std::uint64_t>(i), 30);
        const Estimate mean = meanOf(pairs.over), ratio = ratioOfMeans(pairs.of, pairs.over);
        means += mean.low <= 1 && 1 <= mean.high ? 1 : 0;
        ratios += ratio.low <= 0.8 && 0.8 <= ratio.high ? 1 : 0;
    }
    EXPECT_NEAR(means, 0.95 * times, 45);
    EXPECT_NEAR(ratios, 0.95 * times, 45);
}

TEST(Estimates, RatioToWhatMayBeNothingIsNotKnown) {
    const Pairs pairs(5, 30, 0.05);
    EXPECT_TRUE(std::isnan(ratioOfMeans(pairs.of, pairs.over).value));
    const std::vector<double> same(4, 2.0), half(4, 1.0);
    const Estimate exact = ratioOfMeans(half, same);
    EXPECT_EQ(exact.value, 0.5);
    EXPECT_EQ(exact.low, 0.5);
    EXPECT_EQ(exact.high, 0.5);
}

}  // namespace
}  // namespace mrose
