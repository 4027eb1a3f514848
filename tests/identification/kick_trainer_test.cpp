#include "identification/kick_trainer.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assessment/kick_scores.h"
#include "manipulation/learned_kicker.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// Delay 40 + 40 (1 - power) ms, 4 of it noise; 4 m/s times power plus the robot's speed, noise 0.05 to 0.3 m/s, most
/// at the edge; 1.5 rad for each m off the middle, about `heading`; nothing beyond 8 cm.
KickSample plantedKick(std::int64_t number, double heading) {
    const UniformDraws even(NoiseKey{21, number, 0, 0});
    const NoisePair a = normalPair({21, number, 0, 1}), b = normalPair({21, number, 0, 2});
    KickSample kick;
    kick.state = {
        0.2 + 0.8 * even[0], {0.4 * even[1], 0.6 * even[2] - 0.3}, {0.33 + 0.06 * even[3], 0.2 * even[4] - 0.1}};
    kick.atCommand = kick.state.robot;
    const double side = kick.state.ball_B.y;
    kick.hit = std::abs(side) < 0.08;
    kick.delay = 0.04 + 0.04 * (1 - kick.state.power) + 0.004 * a.first;
    kick.speed = 4 * kick.state.power + kick.state.robot.v + (0.05 + 2.5 * std::abs(side)) * a.second;
    kick.direction = wrapAngle(heading + 1.5 * side + 0.03 * b.first);
    return kick;
}

KickSamples plantedKicks(int count, double heading = 0, int from = 0) {
    KickSamples samples;
    for (int i = from; i < from + count; ++i) samples.kicks.push_back(plantedKick(i, heading));
    samples.commanded = samples.kicks.size();
    return samples;
}

KickTrainerOptions quick() { return {.components = 1, .folds = 3, .hidden = 5, .epochs = 250}; }

TEST(KickTrainer, LearnsWhatWasPlantedAndItsSpread) {
    const auto network = trainKicker(plantedKicks(700), quick());
    ASSERT_TRUE(network) << network.error().message();
    EXPECT_NEAR(network->constant.speedAtFull, 4, 0.05);
    EXPECT_NEAR(network->constant.deadTime, 0.056, 2e-3);
    EXPECT_NEAR(network->constant.hits, 0.8, 0.04);
    const LearnedKicker kicker(*network);
    for (const double power : {0.3, 0.9}) {
        const ReadingDistribution delay = kicker.delay({power, {0.2, 0}, {0.36, 0}});
        EXPECT_NEAR(delay.mean(0), 0.04 + 0.04 * (1 - power), 0.002);
        EXPECT_NEAR(delay.deviation(0), 0.004, 0.001);
        for (const double side : {-0.05, 0.0, 0.06}) {
            const ReadingDistribution left = kicker.departure({power, {0.2, 0}, {0.36, side}});
            EXPECT_NEAR(left.mean(0), 4 * power + 0.2, 0.1) << side;
            EXPECT_NEAR(left.deviation(0), 0.05 + 2.5 * std::abs(side), 0.08) << side;
            EXPECT_NEAR(left.mean(1), 1.5 * side, 0.03) << side;
            EXPECT_NEAR(left.deviation(1), 0.03, 0.012) << side;
            EXPECT_GT(left.probability(), 0.85) << side;
        }
    }
    EXPECT_LT(kicker.departure({0.5, {0.2, 0}, {0.36, 0.098}}).probability(), 0.2);
}

TEST(KickTrainer, IsWorthMoreThanConstantNoiseOnKicksNotLearnedFrom) {
    const auto network = trainKicker(plantedKicks(500), quick());
    ASSERT_TRUE(network);
    const KickSamples others = plantedKicks(300, 0, 5000);
    const auto scores = scoreKicks(LearnedKicker(*network), others.kicks, "learned");
    ASSERT_EQ(scores.size(), 3u);
    const KickScores &learned = scores[0], &noisy = scores[1], &analytic = scores[2];
    EXPECT_EQ(learned.kicks, 300u);
    EXPECT_EQ(learned.hits, others.hits());
    EXPECT_GT(learned.hit, noisy.hit + 0.1);
    EXPECT_GT(learned.delay, noisy.delay + 0.3);
    EXPECT_GT(learned.departure, noisy.departure + 0.3);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(learned.quantities[i].crps, noisy.quantities[i].crps) << i;
        EXPECT_LT(noisy.quantities[i].crps, analytic.quantities[i].crps) << i;
        EXPECT_NEAR(learned.quantities[i].inside50, 0.5, 0.12) << i;
        EXPECT_NEAR(learned.quantities[i].inside90, 0.9, 0.09) << i;
        EXPECT_EQ(analytic.quantities[i].inside90, 0) << i;
    }
    // The mean absolute error, where nothing but a point is predicted.
    double off = 0;
    for (const KickSample& kick : others.kicks)
        if (kick.hit) off += std::abs(kick.delay - network->constant.deadTime) / static_cast<double>(others.hits());
    EXPECT_NEAR(analytic.quantities[0].crps, off, 1e-7);
    EXPECT_TRUE(std::isinf(analytic.delay));
    // Nor is its score on what it held out better than on what it has never seen.
    EXPECT_NEAR(network->heldOut.departure, learned.departure, 0.3);
}

TEST(KickTrainer, AKickerThatFacesBackwardIsNoOther) {
    const auto network = trainKicker(plantedKicks(200, 3.1), quick());
    ASSERT_TRUE(network);
    EXPECT_NEAR(std::abs(wrapAngle(network->direction - 3.1)), 0, 0.03);
    EXPECT_NEAR(LearnedKicker(*network).departure({0.6, {}, {0.36, 0.05}}).mean(1), 0.075, 0.05);
}

TEST(KickTrainer, TheSameKicksGiveTheSameNetwork) {
    KickTrainerOptions few = quick();
    few.epochs = 30;
    const KickSamples samples = plantedKicks(120);
    const auto first = trainKicker(samples, few), second = trainKicker(samples, few);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(*first, *second);
    few.seed = 2;
    EXPECT_NE(trainKicker(samples, few)->learned.regressor, first->learned.regressor);
    const auto read = parseKick(kickText(*first), "k.net");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(*read, *first);
}

TEST(KickTrainer, OfConstantPowerAndWithoutMissesItStillLearnsTheRest) {
    KickSamples samples = plantedKicks(300);
    std::erase_if(samples.kicks, [](const KickSample& kick) { return !kick.hit; });
    for (KickSample& kick : samples.kicks) kick.speed += 4 * (1 - kick.state.power), kick.state.power = 1;
    const auto network = trainKicker(samples, quick());
    ASSERT_TRUE(network) << network.error().message();
    const LearnedKicker kicker(*network);
    EXPECT_GT(kicker.departure({1, {}, {0.36, 0}}).probability(), 0.99);
    EXPECT_EQ(kicker.departure({0.2, {}, {0.36, 0}}).mean(0), kicker.departure({1, {}, {0.36, 0}}).mean(0));
    EXPECT_NEAR(kicker.departure({1, {}, {0.36, 0.05}}).mean(1), 0.075, 0.03);
}

TEST(KickTrainer, TooFewKicksAndCancelling) {
    EXPECT_THAT(trainKicker(plantedKicks(30)).error().cause, HasSubstr("learning needs 40"));
    EXPECT_THAT(trainKicker({}).error().cause, HasSubstr("holds 0 tracked kicks that met a ball"));
    const auto ended = trainKicker(plantedKicks(100), quick(), [](double) { return false; });
    ASSERT_FALSE(ended);
    EXPECT_THAT(ended.error().cause, HasSubstr("cancelled"));
}

}  // namespace
}  // namespace mrose
