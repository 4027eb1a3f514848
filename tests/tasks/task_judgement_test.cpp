#include "tasks/task_judgement.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

using testing::ElementsAre;

TEST(TaskScoreTest, AreWhatTheyAreCalled) {
    TaskData data{.inputs = {"a"}, .target = "t"};
    data.y = {1, 2, 3, 4}, data.x = {0, 0, 0, 0}, data.trial = {1, 2, 3, 4};
    const TaskScore score = scoreOf(data, {1.5, 2, 2, std::nan("")});
    EXPECT_EQ(score.values, 3u) << "without the one that it does not know";
    EXPECT_DOUBLE_EQ(score.absolute, 1.5 / 3);
    EXPECT_DOUBLE_EQ(score.bias, -0.5 / 3);
    EXPECT_DOUBLE_EQ(score.rootMeanSquare, std::sqrt(1.25 / 3));
    EXPECT_DOUBLE_EQ(score.share, 1.5 / 6);
    const TaskScore same = scoreOf(data, {1.1, 2.2, 3.3, 4.4});
    EXPECT_NEAR(same.shareInterval.low, 0.1, 1e-12) << "all trials are off by as much";
    EXPECT_NEAR(same.shareInterval.high, 0.1, 1e-12);
}

/// Trials with two variants, the first of which costs 1, the second 0.5 or 2 by turns, each with noise of its seeds.
TaskData twoVariants(std::uint32_t trials, std::size_t seeds, double noise) {
    TaskData data{.inputs = {"a"}, .target = "cost", .variants = {"steady", "moody"}};
    data.seeds = seeds;
    for (std::uint32_t trial = 1; trial <= trials; ++trial) {
        const double of[2] = {1, trial % 2 == 0 ? 0.5 : 2};
        double sums[2] = {};
        for (std::size_t seed = 0; seed < seeds; ++seed)
            for (std::uint32_t k = 0; k < 2; ++k) {
                const double cost = of[k] + noise * normalNoise({1, trial, static_cast<std::uint32_t>(seed), k});
                data.bySeed.push_back(cost);
                sums[k] += cost / static_cast<double>(seeds);
            }
        data.y.insert(data.y.end(), sums, sums + 2);
        data.x.push_back(trial % 2);
        data.trial.push_back(trial);
    }
    return data;
}

TEST(VariantChoiceTest, WhoKnowsAllReachesTheOracle) {
    const TaskData data = twoVariants(200, 4, 0);
    std::vector<double> knowing;
    for (std::uint32_t trial = 1; trial <= 200; ++trial) {
        knowing.push_back(1);
        knowing.push_back(trial % 2 == 0 ? 0.9 : 1.1);
    }
    const VariantChoice choice = judgeChoice(data, data, knowing, false);
    EXPECT_EQ(choice.best, 0u) << "1 on average, and not 1.25";
    EXPECT_NEAR(choice.mean, 0.75, 1e-12);
    EXPECT_EQ(choice.variants[0].chosen, 100u);
    EXPECT_NEAR(choice.variants[0].gain, 0.25, 1e-12);
    EXPECT_NEAR(choice.variants[1].gain, 0.5, 1e-12);
    EXPECT_EQ(choice.variants[0].share, 0);
    EXPECT_NEAR(choice.variants[1].share, 0.65 / 1.25, 1e-12) << "off by 0.4 of 0.5, and by 0.9 of 2";
    ASSERT_TRUE(choice.oracle);
    EXPECT_NEAR(choice.oracle->mean, 0.75, 1e-12);
    EXPECT_NEAR(choice.oracle->closed, 1, 1e-12);
    EXPECT_NEAR(choice.oracle->agrees, 1, 1e-12);
    EXPECT_TRUE(choice.beatsAll());
    // The mean of 200 draws of 0 or 0.5.
    const double half = 1.96 * 0.25 / std::sqrt(200.0);
    EXPECT_NEAR(choice.variants[0].gainInterval.low, 0.25 - half, 0.2 * half);
    EXPECT_NEAR(choice.variants[0].gainInterval.high, 0.25 + half, 0.2 * half);
}

TEST(VariantChoiceTest, TheGreatestMayBeTheBest) {
    const TaskData data = twoVariants(200, 4, 0);
    std::vector<double> always;
    for (int trial = 0; trial < 200; ++trial) always.insert(always.end(), {0, 1});
    const VariantChoice choice = judgeChoice(data, data, always, true);
    EXPECT_EQ(choice.best, 1u);
    EXPECT_NEAR(choice.mean, 1.25, 1e-12);
    EXPECT_NEAR(choice.variants[0].gain, 0.25, 1e-12) << "more is better";
    EXPECT_FALSE(choice.beatsAll()) << "it is the second itself";
    EXPECT_NEAR(choice.oracle->mean, 1.5, 1e-12);
    EXPECT_NEAR(choice.oracle->closed, 0, 1e-12);
}

TEST(VariantChoiceTest, AnOracleOfNoiseGainsNothing) {
    // Both variants are the same but for noise: who picks by the very seeds that he is judged by seems to gain.
    TaskData data = twoVariants(2000, 2, 0);
    for (std::size_t i = 0; i < data.bySeed.size(); ++i)
        data.bySeed[i] = normalNoise({9, static_cast<std::int64_t>(i), 0, 0});
    for (std::size_t row = 0; row < data.rows(); ++row)
        for (std::size_t k = 0; k < 2; ++k)
            data.y[2 * row + k] = (data.bySeed[4 * row + k] + data.bySeed[4 * row + 2 + k]) / 2;
    const VariantChoice choice = judgeChoice(data, data, data.y, false);
    ASSERT_TRUE(choice.oracle);
    EXPECT_NEAR(choice.oracle->mean, 0, 3 / std::sqrt(4000.0));
    EXPECT_LT(choice.mean, -0.3) << "by its own seeds";
}

TEST(VariantChoiceTest, OneSeedAloneHasNoOracle) {
    const TaskData data = twoVariants(40, 1, 0);
    const TaskJudgement judgement = judge(data, {});
    EXPECT_THAT(judgement.heldOut.bySeed, testing::SizeIs(16));
    const VariantChoice choice = judgeChoice(data, judgement.heldOut, judgement.heldOut.y, false);
    EXPECT_FALSE(choice.oracle);
    EXPECT_EQ(choice.trials, 8u);
    EXPECT_EQ(judgement.predictors.back().name, "mean of all");
    EXPECT_THAT(std::vector<double>(judgement.predictors.back().predicted.begin(),
                                    judgement.predictors.back().predicted.begin() + 2),
                ElementsAre(1.0, testing::DoubleNear(1.25, 1e-12)));
}

}  // namespace
}  // namespace mrose
