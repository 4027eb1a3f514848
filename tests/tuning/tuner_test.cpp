#include "tuning/tuner.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/elementary.h"
#include "world/noise.h"

namespace mrose {
namespace {

TunedParameter parameter(const std::string& name, double from, double to, double start) {
    return {name, 0, 0, {name}, from, to, start};
}

/// A quadratic with a minimum and noise, which differs from trial to trial and not from candidate to candidate but for
/// where the minimum is in it.
class NoisyQuadratic {
public:
    NoisyQuadratic(std::vector<double> minimum, std::vector<double> scale, double shift)
        : minimum_(std::move(minimum)), scale_(std::move(scale)), shift_(shift) {}

    Expected<std::vector<double>> operator()(std::size_t, const std::vector<double>& values, std::uint32_t first,
                                             std::uint32_t count) {
        std::vector<double> costs;
        for (std::uint32_t trial = first; trial < first + count; ++trial) {
            double cost = 2 * normalNoise({5, trial, 0, 99});
            for (std::uint32_t i = 0; i < values.size(); ++i) {
                const double off = (values[i] - minimum_[i]) / scale_[i] + shift_ * normalNoise({5, trial, i, 0});
                cost += off * off;
            }
            costs.push_back(cost);
            ++asked;
        }
        return costs;
    }

    std::int64_t asked = 0;

private:
    std::vector<double> minimum_, scale_;
    double shift_;
};

TunerOptions twoParameters() {
    TunerOptions options;
    options.parameters = {parameter("a", -2, 3, 2.5), parameter("b", 0, 10, 9)};
    options.trials = 64;
    options.heldOut = 200;
    options.evaluations = 4000;
    return options;
}

TEST(TunerTest, FindsTheMinimumWithinItsStandardError) {
    NoisyQuadratic cost({0.7, 4}, {1, 4}, 0.5);
    const auto result = tune(twoParameters(), std::ref(cost));
    ASSERT_TRUE(result);
    ASSERT_TRUE(result->complete);
    const std::vector<double>& best = result->candidates[result->best].values;
    // The minimum of the mean of 64 trials is off by normal noise of 0.5 / 8 of the scale.
    EXPECT_NEAR(best[0], 0.7, 3 * 0.5 / 8);
    EXPECT_NEAR(best[1], 4, 3 * 4 * 0.5 / 8);
    // And it is the minimum of these very trials, to the fineness of the values.
    double mean[2] = {};
    for (std::int64_t trial = 1; trial <= 64; ++trial)
        for (std::uint32_t i = 0; i < 2; ++i) mean[i] += normalNoise({5, trial, i, 0}) / 64;
    EXPECT_NEAR(best[0], 0.7 - 0.5 * mean[0], 0.03);
    EXPECT_NEAR(best[1], 4 - 4 * 0.5 * mean[1], 0.12);
    EXPECT_LE(result->evaluations, 4000);
    EXPECT_EQ(cost.asked, result->evaluations + 2 * 200);
}

TEST(TunerTest, HeldOutTrialsAreThoseThatTheSearchNeverHad) {
    std::uint32_t last = 0, leastHeldOut = 1000;
    NoisyQuadratic cost({0.7, 4}, {1, 4}, 0.5);
    const auto result = tune(twoParameters(), [&](std::size_t candidate, const std::vector<double>& values,
                                                  std::uint32_t first, std::uint32_t count) {
        if (count == 200)
            leastHeldOut = std::min(leastHeldOut, first);
        else
            last = std::max(last, first + count - 1);
        return cost(candidate, values, first, count);
    });
    ASSERT_TRUE(result);
    EXPECT_EQ(last, 64u);
    EXPECT_EQ(leastHeldOut, 65u);
    EXPECT_EQ(result->before, *cost(0, {2.5, 9}, 65, 200));
    EXPECT_EQ(result->after, *cost(0, result->candidates[result->best].values, 65, 200));
}

TEST(TunerTest, FindsLogarithmicAndWholeParameters) {
    TunerOptions options = twoParameters();
    options.parameters = {parameter("gain", 0.001, 10, 5), parameter("count", 1, 9, 8)};
    options.parameters[0].logarithmic = true;
    options.parameters[1].whole = true;
    const auto result = tune(options,
                             [](std::size_t, const std::vector<double>& values, std::uint32_t first,
                                std::uint32_t count) -> Expected<std::vector<double>> {
                                 EXPECT_EQ(values[1], std::round(values[1]));
                                 std::vector<double> costs;
                                 const double off = logarithm(values[0] / 0.02), steps = values[1] - 3;
                                 for (std::uint32_t trial = first; trial < first + count; ++trial)
                                     costs.push_back(off * off + steps * steps + normalNoise({5, trial, 0, 0}));
                                 return costs;
                             });
    ASSERT_TRUE(result);
    const std::vector<double>& best = result->candidates[result->best].values;
    EXPECT_NEAR(best[0], 0.02, 0.002);
    EXPECT_EQ(best[1], 3);
}

TEST(TunerTest, RacingSavesHalfAndFindsTheSame) {
    const auto spent = [](bool racing) {
        NoisyQuadratic cost({0.7, 4}, {1, 4}, 0.2);
        TunerOptions options = twoParameters();
        options.trials = 256;
        options.racing = racing;
        options.evaluations = 1'000'000;
        std::size_t candidates = 0;
        std::vector<double> found;
        // As many candidates both times.
        const auto result = tune(options,
                                 [&](std::size_t candidate, const std::vector<double>& values, std::uint32_t first,
                                     std::uint32_t count) -> Expected<std::vector<double>> {
                                     candidates = candidate + 1;
                                     if (candidates > 60) return std::vector<double>();
                                     return cost(candidate, values, first, count);
                                 });
        EXPECT_TRUE(result);
        if (!result) return std::pair(std::int64_t{0}, found);
        EXPECT_FALSE(result->complete);
        EXPECT_EQ(result->candidates.size(), 60u);
        return std::pair(result->evaluations, result->candidates[result->best].values);
    };
    const auto [without, foundWithout] = spent(false);
    const auto [with, foundWith] = spent(true);
    EXPECT_EQ(without, 60 * 256);
    EXPECT_LT(with, without / 2);
    // As close as the trials can tell: two standard errors of the minimum's place.
    EXPECT_NEAR(foundWith[0], foundWithout[0], 2 * 0.2 / 16);
    EXPECT_NEAR(foundWith[1], foundWithout[1], 2 * 4 * 0.2 / 16);
}

TEST(TunerTest, MoreEvaluationsOnlyAddCandidates) {
    NoisyQuadratic cost({0.7, 4}, {1, 4}, 0.5);
    TunerOptions options = twoParameters();
    options.evaluations = 1000;
    const auto few = tune(options, std::ref(cost));
    options.evaluations = 2000;
    const auto more = tune(options, std::ref(cost));
    ASSERT_TRUE(few && more);
    ASSERT_LT(few->candidates.size(), more->candidates.size());
    for (std::size_t i = 0; i < few->candidates.size(); ++i) {
        EXPECT_EQ(few->candidates[i].values, more->candidates[i].values);
        EXPECT_EQ(few->candidates[i].costs, more->candidates[i].costs);
    }
    EXPECT_LE(more->candidates[more->best].cost, few->candidates[few->best].cost);
}

TEST(TunerTest, WhatIsNowIsTriedAsItIsAndKeptWhereNothingIsBetter) {
    TunerOptions options = twoParameters();
    options.parameters = {parameter("a", 0, 1, 0.123456789)};
    const auto result = tune(options,
                             [](std::size_t, const std::vector<double>& values, std::uint32_t first,
                                std::uint32_t count) -> Expected<std::vector<double>> {
                                 std::vector<double> costs;
                                 for (std::uint32_t trial = first; trial < first + count; ++trial)
                                     costs.push_back(std::abs(values[0] - 0.123456789) + normalNoise({5, trial, 0, 0}));
                                 return costs;
                             });
    ASSERT_TRUE(result);
    EXPECT_EQ(result->candidates[0].values, std::vector<double>{0.123456789});
    EXPECT_EQ(result->best, 0u);
    EXPECT_EQ(result->before, result->after);
}

TEST(TunerTest, FewWholeValuesAreAllTriedAndThenItEnds) {
    TunerOptions options = twoParameters();
    options.parameters = {parameter("count", 1, 4, 1)};
    options.parameters[0].whole = true;
    options.evaluations = 1'000'000;
    const auto result = tune(options,
                             [](std::size_t, const std::vector<double>& values, std::uint32_t,
                                std::uint32_t count) -> Expected<std::vector<double>> {
                                 return std::vector<double>(count, std::abs(values[0] - 3));
                             });
    ASSERT_TRUE(result);
    EXPECT_TRUE(result->complete);
    EXPECT_EQ(result->candidates.size(), 4u);
    EXPECT_EQ(result->candidates[result->best].values, std::vector<double>{3});
}

TEST(TunerTest, ErrorsEndIt) {
    int asked = 0;
    const auto result = tune(twoParameters(),
                             [&](std::size_t candidate, const std::vector<double>&, std::uint32_t,
                                 std::uint32_t count) -> Expected<std::vector<double>> {
                                 ++asked;
                                 if (candidate == 3) return fail("x.toml", "is wrong");
                                 return std::vector<double>(count, static_cast<double>(candidate));
                             });
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message(), "x.toml: is wrong");
    EXPECT_EQ(asked, 4 + 2 + 1) << "four looks of the first, two dropped at their first look, and the wrong one";
}

TEST(TunedParameterTest, SharesAndValuesAreInverse) {
    TunedParameter log = parameter("a", 0.01, 100, 1), whole = parameter("b", -2, 5, 0);
    log.logarithmic = true;
    whole.whole = true;
    EXPECT_EQ(valueAt(log, 0), 0.01);
    EXPECT_EQ(valueAt(log, 1), 100);
    EXPECT_NEAR(valueAt(log, 0.5), 1, 1e-3);
    EXPECT_NEAR(shareOf(log, 0.1), 0.25, 1e-12);
    for (int n = -2; n <= 5; ++n) EXPECT_EQ(valueAt(whole, shareOf(whole, n)), n);
    // As much of the way for the ends as for the others.
    EXPECT_EQ(valueAt(whole, 0.12), -2);
    EXPECT_EQ(valueAt(whole, 0.13), -1);
    // Short numbers.
    EXPECT_EQ(valueAt(parameter("c", 0, 1, 0), 0.123456), 0.123);
    EXPECT_EQ(valueAt(parameter("c", 0, 1000, 0), 0.123456), 123);
    EXPECT_EQ(valueAt(parameter("c", 0.25, 0.75, 0), 2), 0.75);
}

}  // namespace
}  // namespace mrose
