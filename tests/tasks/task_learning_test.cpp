#include "tasks/task_learning.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

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
    const auto scores = heldOutScores(data, {*network});
    ASSERT_EQ(scores.size(), 2u);
    EXPECT_EQ(scores[0].name, nameOf(GetParam()));
    EXPECT_EQ(scores[0].rows, 600u);
    const double most = GetParam() == RegressorFamily::network ? 0.01
                        : GetParam() == RegressorFamily::table ? 0.03
                                                               : 0.06;
    EXPECT_LT(scores[0].share, most);
    EXPECT_EQ(network->heldOutError, scores[0].share);
    EXPECT_LE(scores[0].shareLow, scores[0].share);
    EXPECT_GE(scores[0].shareHigh, scores[0].share);
    EXPECT_GT(scores[1].share, 0.3) << "the mean of all";
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

TEST(TaskScoreTest, AreWhatTheyAreCalled) {
    TaskData data{.inputs = {"a"}, .target = "t"};
    data.y = {1, 2, 3, 4}, data.x = {0, 0, 0, 0}, data.trial = {1, 2, 3, 4};
    const TaskScore score = scoreOf("s", data, {1.5, 2, 2, std::nan("")});
    EXPECT_EQ(score.rows, 3u) << "without the one that it does not know";
    EXPECT_DOUBLE_EQ(score.absolute, 1.5 / 3);
    EXPECT_DOUBLE_EQ(score.bias, -0.5 / 3);
    EXPECT_DOUBLE_EQ(score.rootMeanSquare, std::sqrt(1.25 / 3));
    EXPECT_DOUBLE_EQ(score.share, 1.5 / 6);
    const TaskScore same = scoreOf("s", data, {1.1, 2.2, 3.3, 4.4});
    EXPECT_NEAR(same.shareLow, 0.1, 1e-12) << "all trials are off by as much";
    EXPECT_NEAR(same.shareHigh, 0.1, 1e-12);
}

}  // namespace
}  // namespace mrose
