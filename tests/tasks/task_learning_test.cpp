#include "tasks/task_learning.h"

#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tasks/task_judgement.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// t = 3 + a^2 + 2 sin(b), a in +-1, b in +-2; c says nothing. A trial has two rows.
TaskData synthetic(std::size_t trials, double noise = 0) {
    TaskData data{.inputs = {"a", "b", "c"}, .target = "t"};
    for (std::uint32_t trial = 1; trial <= trials; ++trial) {
        const UniformDraws u({1, trial, 0, 0});
        const double a = 2 * u[0] - 1, b = 4 * u[1] - 2, c = u[2];
        for (int seed = 0; seed < 2; ++seed) {
            data.x.insert(data.x.end(), {a, b, c});
            data.y.push_back(3 + a * a + 2 * std::sin(b) +
                             noise * normalNoise({2, trial, static_cast<std::uint32_t>(seed), 0}));
            data.trial.push_back(trial);
        }
    }
    return data;
}

class TaskFamilies : public testing::TestWithParam<RegressorFamily> {
protected:
    TaskLearning how() const { return {.family = GetParam(), .hidden = 10, .members = 3, .trees = 30}; }
};
INSTANTIATE_TEST_SUITE_P(All, TaskFamilies,
                         testing::Values(RegressorFamily::network, RegressorFamily::table, RegressorFamily::trees,
                                         RegressorFamily::neighbours),
                         [](const auto& family) { return std::string(nameOf(family.param)); });

TEST_P(TaskFamilies, LearnWhatIsThereToBeLearned) {
    const TaskData data = synthetic(1500);
    const auto network = learnTask(data, how());
    ASSERT_TRUE(network) << network.error().message();
    const auto predictors = judge(data, {*network}).predictors;
    ASSERT_EQ(predictors.size(), 2u);
    EXPECT_EQ(predictors[0].name, nameOf(GetParam()));
    const TaskScore &score = predictors[0].score, &guess = predictors[1].score;
    EXPECT_EQ(score.values, 600u);
    const double most = GetParam() == RegressorFamily::network ? 0.01
                        : GetParam() == RegressorFamily::table ? 0.03
                                                               : 0.06;
    EXPECT_LT(score.share, most);
    EXPECT_EQ(network->heldOutError, score.share);
    EXPECT_LE(score.shareInterval.low, score.share);
    EXPECT_GE(score.shareInterval.high, score.share);
    EXPECT_GT(guess.share, 0.3) << "the mean of all";
    EXPECT_EQ(network->learned.holdOut.every, 5);
    EXPECT_TRUE(network->learned.synthetic);
}

TEST_P(TaskFamilies, WhatIsHeldOutChangesNothing) {
    const TaskData data = synthetic(300, 0.1);
    TaskData garbled = data;
    for (std::size_t row = 0; row < garbled.rows(); ++row)
        if (garbled.trial[row] % 5 == 0) garbled.y[row] = 100, garbled.x[3 * row] = -50;
    auto network = learnTask(data, how()), other = learnTask(garbled, how());
    ASSERT_TRUE(network && other);
    EXPECT_GT(other->heldOutError, network->heldOutError);
    other->heldOutError = network->heldOutError;
    EXPECT_TRUE(*network == *other);
}

TEST_P(TaskFamilies, AreTheSameForAnyNumberOfThreads) {
    const TaskData data = synthetic(300, 0.1);
    std::vector<TaskNetwork> networks;
    for (const std::size_t threads : {1, 8}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const auto network = learnTask(data, how());
        ASSERT_TRUE(network);
        networks.push_back(*network);
    }
    EXPECT_TRUE(networks[0] == networks[1]);
}

TEST_P(TaskFamilies, FileGivesTheSameAgain) {
    const TaskData data = synthetic(200, 0.1);
    const auto network = learnTask(data, how());
    ASSERT_TRUE(network);
    const auto read = parseTask(taskFileText(*network), "t.net");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_TRUE(*read == *network);
    EXPECT_EQ(predictions(*read, data), predictions(*network, data));
}

TEST(TaskLearningTest, LogarithmsAreOfWhatIsAboveZero) {
    TaskData data = synthetic(400);
    for (double& y : data.y) y = std::exp(2 * y);
    const auto network = learnTask(data, {.logarithmic = true, .hidden = 10, .members = 3});
    ASSERT_TRUE(network) << network.error().message();
    for (const double y : predictions(*network, data)) EXPECT_GT(y, 0);
    EXPECT_LT(network->heldOutError, 0.15);
    data.y[1] = 0;
    const auto refused = learnTask(data, {.logarithmic = true});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), HasSubstr("t: is not above 0 in all rows"));
}

TEST(TaskLearningTest, TooFewRowsAreToldAndProgressEndsIt) {
    const auto few = learnTask(synthetic(20), {});
    ASSERT_FALSE(few);
    EXPECT_THAT(few.error().message(), HasSubstr("leaves 32 rows to learn from; expected at least 50"));
    for (const RegressorFamily family :
         {RegressorFamily::network, RegressorFamily::table, RegressorFamily::trees, RegressorFamily::neighbours}) {
        const auto ended = learnTask(synthetic(200), {.family = family}, [](double) { return false; });
        ASSERT_FALSE(ended);
        EXPECT_THAT(ended.error().message(), HasSubstr("was interrupted"));
    }
}

TEST(TaskLearningTest, ANetworkHasAnOutputForEachVariant) {
    TaskData data = synthetic(600);
    data.variants = {"first", "second"};
    std::vector<double> both;
    for (std::size_t row = 0; row < data.y.size(); ++row) {
        both.push_back(data.y[row]);
        both.push_back(5 - data.x[3 * row]);  // 5 - a
    }
    data.y = both;
    for (const RegressorFamily family :
         {RegressorFamily::network, RegressorFamily::table, RegressorFamily::trees, RegressorFamily::neighbours}) {
        const auto network = learnTask(data, {.family = family, .hidden = 10, .members = 3, .trees = 30});
        ASSERT_TRUE(network) << network.error().message();
        ASSERT_EQ(network->learned.outputs.size(), 2u);
        EXPECT_EQ(network->learned.outputs[1].name, "second");
        const TaskInference inference(*network);
        double values[2];
        inference.evaluate(std::array{0.5, 1.0, 0.5}.data(), values);
        EXPECT_NEAR(values[0], 3.25 + 2 * std::sin(1.0), 0.35) << nameOf(family);
        EXPECT_NEAR(values[1], 4.5, 0.2) << nameOf(family);
    }
}

/// Of few rows with much noise, and many inputs that say nothing, learning all that can be learned is too much.
TEST(TaskLearningTest, TrainsInTheWayThatPredictsBetter) {
    const auto exact = learnTask(synthetic(1500), {.hidden = 10, .members = 2});
    ASSERT_TRUE(exact) << exact.error().message();
    EXPECT_EQ(exact->learned.training.method, "lm");

    constexpr std::size_t idle = 20;
    const TaskData few = synthetic(300, 1);
    TaskData noisy = few;
    noisy.x.clear();
    for (std::size_t i = 0; i < idle; ++i) noisy.inputs.push_back("idle " + std::to_string(i));
    for (std::size_t row = 0; row < few.rows(); ++row) {
        noisy.x.insert(noisy.x.end(), few.x.begin() + 3 * row, few.x.begin() + 3 * (row + 1));
        for (std::size_t i = 0; i < idle; ++i)
            noisy.x.push_back(normalNoise({3, static_cast<std::uint32_t>(row / 2), static_cast<std::uint32_t>(i), 0}));
    }
    const auto decayed = learnTask(noisy, {.hidden = 12, .members = 2});
    ASSERT_TRUE(decayed) << decayed.error().message();
    EXPECT_EQ(decayed->learned.training.method, "irprop+");
}

TEST(TaskLearningTest, WhatNoFileHoldsIsRefused) {
    TaskData data{.inputs = std::vector<std::string>(300, "i"), .target = "t"};
    for (std::uint32_t trial = 1; trial <= 100; ++trial) {
        data.x.insert(data.x.end(), 300, 0.0);
        data.y.push_back(trial);
        data.trial.push_back(trial);
    }
    const auto refused = learnTask(data, {});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), HasSubstr("has 300 inputs and 1 outputs; expected at most 256 and 256"));
}

}  // namespace
}  // namespace mrose
