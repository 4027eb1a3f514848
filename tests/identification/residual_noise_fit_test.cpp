#include "identification/residual_noise_fit.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "assessment/windows.h"
#include "identification/driven_log.h"
#include "identification/network_trainer.h"
#include "identification/recipes.h"
#include "motion/kinematic.h"
#include "motion/learned_model.h"

namespace mrose {
namespace {

using Axis = ResidualNoise::Axis;

constexpr Nanoseconds period = 100'000'000;
constexpr std::size_t rolloutLength = 50, memberCount = 3;

/// Slip that lasts, a heading that wanders as much as the robot turns, and members that disagree.
ResidualNoise plantedResidualNoise() {
    ResidualNoise noise;
    noise.processes = {{Axis::forward, 0.5, {{NoiseTrait::distance, 0.25}}},
                       {Axis::left, 30, {{NoiseTrait::distance, 0.2}}},
                       {Axis::heading, 0.2, {{NoiseTrait::rotation, 0.3}}}};
    noise.members = {1.2, 1};
    noise.scale = {0.3, 3};
    return noise;
}

/// Rollouts whose truth is such a noise's, at rising speeds.
ResidualRollouts plantedRollouts(std::size_t count, const ResidualNoise& noise, std::uint64_t seed = 77) {
    ResidualRollouts rollouts;
    rollouts.length = rolloutLength;
    rollouts.members = memberCount;
    const NoiseProcesses processes(noise, memberCount, 0.1);
    for (std::size_t r = 0; r < count; ++r) {
        std::vector<float> values(processes.values());
        for (std::size_t k = 0; k < rolloutLength; ++k) {
            const auto at = static_cast<std::int64_t>(k);
            const double speed = 0.1 + 0.3 * static_cast<double>(r % 7) / 6, turn = 0.2 * static_cast<double>(r % 5);
            const Pose mean{0.1 * speed, 0, 0.1 * turn};
            NoiseTraits traits{1, mean.x, mean.heading, 0, 0, mean.x, 0, 0};
            std::vector<Pose> deviations;
            for (std::uint32_t m = 0; m < memberCount; ++m)
                deviations.push_back({0.001 * normalNoise({9, at, static_cast<std::uint32_t>(r), m}), 0,
                                      0.004 * normalNoise({8, at, static_cast<std::uint32_t>(r), m})});
            processes.advance({seed, at, static_cast<std::uint32_t>(r), 0}, k > 0, values);
            const Pose error = processes.noise(values, traits, deviations);
            rollouts.mean.push_back(mean);
            rollouts.truth.push_back({mean.x + error.x, mean.y + error.y, mean.heading + error.heading});
            rollouts.traits.push_back(traits);
            rollouts.deviations.insert(rollouts.deviations.end(), deviations.begin(), deviations.end());
        }
    }
    return rollouts;
}

ResidualNoise multiplied(ResidualNoise noise, double factor) {
    for (ResidualNoise::Process& process : noise.processes)
        for (ResidualNoise::Share& share : process.amplitude) share.weight *= factor;
    noise.members.weight *= factor;
    return noise;
}

/// Different processes can make nearly the same of a rollout, so that not their weights are to be found, but a noise
/// that forecasts others of its rollouts as well as itself.
TEST(ResidualNoiseFit, ForecastsAsWellAsThePlantedNoise) {
    const ResidualNoise planted = plantedResidualNoise();
    const ResidualNoise found = fitResidualNoise(plantedRollouts(600, planted), period);
    EXPECT_EQ(found.rollouts, 600);
    EXPECT_NEAR(found.horizon, 5, 1e-12);
    ASSERT_TRUE(found.most);
    for (const auto& [trait, most] : {std::pair{NoiseTrait::moving, 1.0}, std::pair{NoiseTrait::distance, 0.04},
                                      std::pair{NoiseTrait::rotation, 0.08}, std::pair{NoiseTrait::headingChange, 0.0}})
        EXPECT_NEAR((*found.most)[static_cast<std::size_t>(trait)], most, 1e-12);
    const ResidualRollouts others = plantedRollouts(900, planted, 78);
    const auto loss = [&](const ResidualNoise& noise) { return residualLoss(noise, others, period, {.seed = 5}); };
    const double best = loss(planted);
    EXPECT_LT(loss(found), 1.01 * best);
    for (const double factor : {0.0, 0.5, 2.0}) EXPECT_GT(loss(multiplied(planted, factor)), 1.04 * best) << factor;
    ResidualNoise forgetful = planted;
    for (ResidualNoise::Process& process : forgetful.processes) process.time = 0;
    EXPECT_GT(loss(forgetful), 1.04 * best);
}

TEST(ResidualNoiseFit, IsTheSameAgain) {
    const ResidualRollouts rollouts = plantedRollouts(30, plantedResidualNoise());
    ResidualNoiseOptions options;
    options.epochs = 5;
    EXPECT_EQ(fitResidualNoise(rollouts, period, options), fitResidualNoise(rollouts, period, options));
    options.seed = 2;
    EXPECT_NE(fitResidualNoise(rollouts, period, options), fitResidualNoise(rollouts, period, {.epochs = 5}));
}

TEST(ResidualNoiseFit, EndsWhenItIsTold) {
    std::vector<double> shares;
    fitResidualNoise(plantedRollouts(30, plantedResidualNoise()), period, {.epochs = 40}, [&](double share) {
        shares.push_back(share);
        return shares.size() < 2;
    });
    EXPECT_EQ(shares.size(), 2u);
}

MotionSamples runsOf(std::initializer_list<std::size_t> counts) {
    MotionSamples samples;
    samples.period = period;
    for (const std::size_t count : counts) {
        samples.runs.push_back({samples.samples.size(), count});
        samples.samples.resize(samples.samples.size() + count);
    }
    return samples;
}

TEST(ResidualNoiseFit, ItsRolloutsAreAsLongAsTheRunsAllow) {
    EXPECT_EQ(residualLength(runsOf({3000})), 100u) << "10 s";
    EXPECT_EQ(residualLength(runsOf({1000})), 42u) << "20 of them fit in: 100, 75, 56, 42";
    EXPECT_EQ(residualLength(runsOf({9, 9})), 0u) << "shorter than 1 s";
    EXPECT_EQ(residualLength(runsOf({50, 50})), 0u) << "too few";
    EXPECT_EQ(residualLength(runsOf({})), 0u);
}

/// So that what is uncertain about the start counts as noise, too.
TEST(ResidualNoiseFit, ItsRolloutsBeginAsPredictionsDo) {
    const KinematicParameters lagged{{0.12, 0.2, 0.9, 0, 0, 0}, {0.12, 0.2, 0.95, 0, 0, 0}, 0};
    const std::vector<Log> logs{drivenLog(KinematicModel(lagged, 20 * ms), 8, 30, 11)};
    const MotionNetwork blueprint =
        stateBlueprint(RobotTraits{"test", {}, 0, false}, {"1"}, {0.12, 0.2, 0.12, 0.2, 0.2, 0.2, {}});
    SampleOptions sampling;
    sampling.phases = sampling.folds = 1;
    sampling.measuredStarts = true;
    const auto samples = motionSamples(logs, blueprint, sampling);
    ASSERT_TRUE(samples);
    SampleOptions parts = sampling;
    parts.folds = 2;
    NetworkTrainerOptions options;
    options.members = 1;
    options.epochs = 20;
    options.linearStart = true;
    const auto trained = trainNetwork(blueprint, *motionSamples(logs, blueprint, parts), options);
    ASSERT_TRUE(trained) << trained.error().message();

    constexpr std::size_t length = 20;
    ResidualRollouts rollouts;
    addResidualRollouts(trained->network, *samples, length, rollouts);
    std::vector<RolloutStart> starts;
    for (const SampleRun& run : samples->runs)
        for (std::size_t i = 1; i + length <= run.count; i += length / 3) {
            const MotionSample& sample = samples->samples[run.first + i];
            const auto number = static_cast<std::size_t>(&run - samples->runs.data());  // a run for each trajectory
            const auto start =
                measureStart(logs[0].robots[0].trajectories[number], sample.start, static_cast<int>(length));
            ASSERT_TRUE(start);
            starts.push_back(*start);
        }
    ASSERT_EQ(rollouts.count(), starts.size());
    const LearnedModel model(std::make_shared<const LearnedMotion>(trained->network), "1");
    const auto poses = rollOut(model, starts);
    ASSERT_TRUE(poses);
    double fastest = 0;
    for (std::size_t r = 0; r < starts.size(); ++r) {
        Pose pose = starts[r].pose;
        for (std::size_t k = 0; k < length; ++k) {
            pose = pose * rollouts.mean[r * length + k];
            EXPECT_NEAR(pose.x, (*poses)[r][k].x, 2e-5);
            EXPECT_NEAR(pose.y, (*poses)[r][k].y, 2e-5);
            EXPECT_NEAR(pose.heading, (*poses)[r][k].heading, 2e-5);
        }
        fastest = std::max(fastest, std::abs(starts[r].velocity->velocity.v));
    }
    EXPECT_GT(fastest, 0.2);
}

}  // namespace
}  // namespace mrose
