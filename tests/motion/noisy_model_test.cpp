#include "motion/noisy_model.h"

#include <cmath>

#include <gtest/gtest.h>

#include "motion/kinematic.h"
#include "motion/learned_model.h"
#include "motion/network_fixture.h"
#include "support/units.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

const MotionNoise noise{0.1, 0.2, 0.3};
const NoiseKey key{7, 42, 3, channelOf(NoiseChannel::motion)};

std::shared_ptr<const MotionModel> kinematic() { return std::make_shared<const KinematicModel>(KinematicParameters{}); }

MotionInput driving(const CommandHistory& history, const std::optional<NoiseKey>& drawn) {
    MotionInput input{&history, 400 * ms, {0.4, -0.3}};
    input.noise = drawn;
    return input;
}

TEST(NoisyModel, AddsTheDrawsOfItsKeyToWayAndTurn) {
    CommandHistory history;
    history.issue(0, {0.5, -0.8});
    const MotionInput input = driving(history, key);
    const MotionStep mean = kinematic()->predictOne(input), step = withNoise(kinematic(), noise)->predictOne(input);
    const NoisePair draw = normalPair(key);
    const double way = std::hypot(mean.increment.x, mean.increment.y);
    const double along = mean.increment.x + 0.1 * way * draw.first;
    const double turned = mean.increment.heading + std::hypot(0.2 * mean.increment.heading, 0.3 * way) * draw.second;
    EXPECT_NEAR(step.increment.x, along, 1e-15);
    EXPECT_EQ(step.increment.y, mean.increment.y);
    EXPECT_NEAR(step.increment.heading, turned, 1e-15);
    EXPECT_NE(step.increment.x, mean.increment.x);
    EXPECT_EQ(step.velocity, mean.velocity);
}

TEST(NoisyModel, ItsMemoryIsTheOthersAndKnowsWhatItKnows) {
    const auto learned = std::make_shared<const LearnedModel>(
        std::make_shared<const LearnedMotion>(arbitraryNetwork(MotionNetwork::Form::history)), "a");
    const auto noisy = withNoise(learned, noise);
    TrackerEvidence seen;
    seen.add(1, 0, 0.2);
    seen.add(0, 1, 0.1);
    std::vector<std::byte> one(learned->memorySize()), other = one;
    learned->adapt(one, seen);
    EXPECT_NE(one, other);
    noisy->adapt(other, seen);
    EXPECT_EQ(one, other);
    noisy->restart(other);
    EXPECT_EQ(one, other) << "where the tracked point lies stays";
}

TEST(NoisyModel, IsTheMeanWhereNothingIsDrawn) {
    CommandHistory history;
    history.issue(0, {0.5, -0.8});
    const MotionInput input = driving(history, std::nullopt);
    EXPECT_EQ(withNoise(kinematic(), noise)->predictOne(input).increment, kinematic()->predictOne(input).increment);
}

TEST(NoisyModel, DrawsTheSameAloneAndInABatchWithItsSpread) {
    CommandHistory history;
    history.issue(0, {0.5, -0.8});
    std::vector<MotionInput> inputs;
    for (std::uint32_t robot = 0; robot < 5; ++robot) {
        NoiseKey own = key;
        own.robot = robot;
        inputs.push_back(driving(history, own));
    }
    const auto model = withNoise(kinematic(), noise);
    std::vector<MotionStep> steps(5), again(5);
    std::vector<MotionSpread> spreads(5);
    model->predict(inputs, steps);
    model->predictWithSpread(inputs, again, spreads);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(steps[i].increment, model->predictOne(inputs[i]).increment);
        EXPECT_EQ(steps[i].increment, again[i].increment);
    }
    for (std::size_t i = 1; i < 5; ++i) EXPECT_NE(steps[i].increment, steps[0].increment);
}

TEST(NoisyModel, IsInTheOthersPlaceInAllElse) {
    const auto learned = std::make_shared<const LearnedModel>(
        std::make_shared<const LearnedMotion>(arbitraryNetwork(MotionNetwork::Form::history)), "b");
    const auto noisy = withNoise(learned, noise);
    EXPECT_EQ(noisy->period(), learned->period());
    EXPECT_EQ(noisy->lookBack(), learned->lookBack());
    EXPECT_EQ(noisy->deadTimes(), learned->deadTimes());
    ASSERT_EQ(noisy->memorySize(), learned->memorySize());
    // Its memory is the other's: after a period both remember and explain the same.
    CommandHistory history;
    history.issue(0, {0.5, -0.8});
    MotionInput input = driving(history, key);
    std::vector<std::byte> ofNoisy(noisy->memorySize()), ofLearned(noisy->memorySize());
    noisy->start(ofNoisy);
    input.memory = ofNoisy;
    noisy->predictOne(input);
    input.memory = ofLearned;
    learned->predictOne(input);
    EXPECT_EQ(ofNoisy, ofLearned);
    ASSERT_EQ(explained(*noisy, ofNoisy).size(), 2u);
    EXPECT_EQ(explained(*noisy, ofNoisy)[0].value, explained(*learned, ofLearned)[0].value);
}

TEST(NoisyModel, IsFoundAndLeftOut) {
    const auto learned = std::make_shared<const LearnedModel>(
        std::make_shared<const LearnedMotion>(arbitraryNetwork(MotionNetwork::Form::history)), "b");
    const auto noisy = withNoise(learned, noise);
    EXPECT_EQ(noiseOf(*noisy), noise);
    EXPECT_TRUE(noiseOf(*learned).none());
    EXPECT_EQ(learnedModel(*noisy), learned.get());
    EXPECT_EQ(learnedModel(*learned), learned.get());
    EXPECT_EQ(learnedModel(*withNoise(kinematic(), noise)), nullptr);
    EXPECT_EQ(withNoise(noisy, {}), learned) << "without noise it is the model alone";
    const MotionNoise other{0.5, 0, 0};
    EXPECT_EQ(noiseOf(*withNoise(noisy, other)), other) << "the other noise in its place";
    EXPECT_EQ(&withNoise(noisy, other)->underlying(), learned.get());
}

}  // namespace
}  // namespace mrose
