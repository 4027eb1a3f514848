// Self-localisations learned from logs: of the model's own class, whose constants are recovered, and of another class.
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"
#include "identification/calibration.h"
#include "identification/planted_sensors.h"
#include "identification/sensor_samples.h"
#include "identification/sensor_summary.h"
#include "identification/sensor_trainer.h"
#include "logs/pose_grid.h"
#include "perception/learned_sensor.h"

namespace mrose {
namespace {

constexpr Nanoseconds millisecond = 1'000'000;

/// A localiser of the model's own class.
struct PlantedLocaliser {
    double latency = 0.12, period = 0.1;
    double grossShare = 0.01;
    ReadingNoises noise = {ReadingNoise{0, 0.5, 0.8}, {0, 0.6, 1.5}, {0, 0.3, 1.5}, {0, 0.5, 3}};

    ReadingDistribution of(const SensedState& state) const {
        ReadingDistribution d;
        d.form.dimensions = 3;
        d.threshold = 2 - 1.5 * std::abs(state.velocity.w);
        const double wide = exponential(0.35 * state.own.x);
        d.component[0].mean = {0.05 * state.own.y, 0.03, -0.02};
        d.component[0].spread = {0.06 * wide, 0.04 * wide, 0.03};
        d.gross = {grossShare, {4, 4, 3}};
        return d;
    }
};

Velocity velocityOnCurve(const PlantedSensors& plant, double seconds) {
    const Pose from = planted::curve(plant, seconds - 0.1), to = planted::curve(plant, seconds + 0.1);
    return {length(position(to) - position(from)) / 0.2, wrapAngle(to.heading - from.heading) / 0.2};
}

Log plantedLocalisation(const PlantedLocaliser& localiser, double seconds, std::uint64_t seed) {
    PlantedSensors plant{.seconds = seconds, .headingNoise = 0, .seed = seed};
    Log log = plantedSensorLog(plant);
    SensorLog sensor{.sensor = "localisation"};
    ChannelNumbers slow{};
    std::int64_t look = 0;
    for (double t = 1; t < seconds - 1; t += localiser.period, ++look) {
        const auto normals = [&](std::uint32_t channel) { return normalPair({seed, look, 1, channel}); };
        ChannelNumbers numbers{};
        for (std::uint32_t i = 0; i < readingChannels; ++i) {
            const ReadingNoise& noise = localiser.noise[i];
            const NoisePair n = normals(i);
            slow[i] = (look == 0 ? Lasting{} : Lasting::after(localiser.period, noise.slowTime)).next(slow[i], n.first);
            numbers[i] = std::sqrt(noise.slow) * slow[i] + std::sqrt(1 - noise.slow) * n.second;
        }
        SensedState state;
        state.own = planted::curve(plant, t - localiser.latency);
        state.velocity = velocityOnCurve(plant, t - localiser.latency);
        const ReadingDraw draw{numbers[0], uniformNoise({seed, look, 1, 9}), {numbers[1], numbers[2], numbers[3]}};
        const ReadingDistribution distribution = localiser.of(state);
        if (!distribution.reports(draw)) continue;
        const ReadingError error = distribution.error(draw);
        sensor.poses.push_back({planted::instant(t), state.own * Pose{error[0], error[1], error[2]}});
    }
    log.robots[0].trajectories[0].sensors = {sensor};
    return log;
}

SensorSampleOptions samplingOf(const SensorSummary& found) {
    return {.sensor = "localisation",
            .measures = SensorNetwork::Measures::pose,
            .latency = fromSeconds(found.lateness.lateness),
            .period = found.clocked ? found.period : 0};
}

SensorNetwork blueprintOf(const SensorSummary& found) {
    SensorNetwork blueprint;
    blueprint.sensor = "localisation";
    blueprint.measures = SensorNetwork::Measures::pose;
    blueprint.period = found.period;
    blueprint.latency = fromSeconds(found.lateness.lateness);
    return blueprint;
}

SensorTrainerOptions quick(int components) {
    SensorTrainerOptions options{.components = components};
    options.reported.folds = options.error.folds = 2;
    options.reported.epochs = options.error.epochs = 200;
    return options;
}

std::vector<Log> only(Log log) {
    std::vector<Log> logs;
    logs.push_back(std::move(log));
    return logs;
}

TEST(OwnPoses, EachInstantOfTheClockIsACase) {
    Log log = plantedSensorLog({.lateness = 0.1, .seconds = 60, .bearingNoise = 0, .headingNoise = 0});
    std::vector<StampedPose>& poses = log.robots[0].trajectories[0].sensors[1].poses;
    const std::size_t all = poses.size();
    poses.erase(poses.begin() + 20, poses.begin() + 23);
    SensorSampleOptions options{
        .sensor = "slam", .measures = SensorNetwork::Measures::pose, .latency = 100 * millisecond};
    options.period = 200 * millisecond;
    const SensorSamples samples = sensorSamples(std::span(&log, 1), options);
    ASSERT_EQ(samples.cases.size(), all);
    EXPECT_EQ(samples.readings(), all - 3);
    for (std::size_t i = 0; i < all; ++i) EXPECT_EQ(samples.cases[i].reported, i < 20 || i >= 23) << i;
    options.period = 0;
    EXPECT_EQ(sensorSamples(std::span(&log, 1), options).cases.size(), all - 3) << "nobody knows when it looked";
}

TEST(OwnPoses, ErrorsAreInTheRobotsTrueFrame) {
    Log log = plantedSensorLog({.seconds = 60, .headingNoise = 0});
    Trajectory& trajectory = log.robots[0].trajectories[0];
    SensorLog sensor{.sensor = "gps"};
    for (std::size_t i = 100; i < 2000; i += 10) {
        const StampedPose& truth = trajectory.poses[i];
        sensor.poses.push_back(
            {truth.time + 60 * millisecond, truthAt(trajectory.poses, truth.time) * Pose{0.2, -0.1, 7}});
    }
    trajectory.sensors = {sensor};
    const SensorSamples samples = sensorSamples(
        std::span(&log, 1), {.sensor = "gps", .measures = SensorNetwork::Measures::pose, .latency = 60 * millisecond});
    ASSERT_EQ(samples.cases.size(), sensor.poses.size());
    for (const SensorCase& one : samples.cases) {
        EXPECT_NEAR(one.error[0], 0.2, 1e-9);
        EXPECT_NEAR(one.error[1], -0.1, 1e-9);
        EXPECT_NEAR(one.error[2], 7 - 2 * std::numbers::pi, 1e-9);
    }
}

TEST(OwnPoses, APlantedLocaliserIsRecovered) {
    const PlantedLocaliser localiser;
    const std::vector<Log> logs = only(plantedLocalisation(localiser, 2400, 5));
    const SensorSummary found = summariseSensor(logs, "localisation", {});
    ASSERT_TRUE(found.lateness.identified) << found.lateness.reason;
    EXPECT_NEAR(found.lateness.lateness, localiser.latency, std::max(4 * found.lateness.error, 0.01));
    EXPECT_LT(found.lateness.error, 0.02);
    EXPECT_TRUE(found.clocked);
    EXPECT_NEAR(toSeconds(found.period), localiser.period, 1e-6);
    const SensorSamples samples = sensorSamples(logs, samplingOf(found));
    const auto trained = trainSensor(blueprintOf(found), samples, quick(1));
    ASSERT_TRUE(trained) << trained.error().message();
    const SensorNetwork& network = *trained;
    EXPECT_NEAR(network.gross.share, localiser.grossShare, 0.3 * localiser.grossShare);
    for (std::size_t i = 0; i < readingChannels; ++i) {
        EXPECT_NEAR(network.noise[i].slow, localiser.noise[i].slow, 0.12) << i;
        EXPECT_NEAR(std::log(network.noise[i].slowTime / localiser.noise[i].slowTime), 0, 0.5) << i;
        EXPECT_EQ(network.noise[i].subject, 0);
        EXPECT_EQ(network.noise[i].look, 0);
    }
    const LearnedSensor sensor(network);
    double spreads = 0, chances = 0, means = 0;
    for (const SensorCase& one : samples.cases) {
        ReadingDistribution learned;
        sensor.distributions({&one.state, 1}, 0, {&learned, 1});
        const ReadingDistribution planted = localiser.of(one.state);
        for (std::size_t d = 0; d < 3; ++d) {
            const auto &a = learned.component[0], &b = planted.component[0];
            spreads += std::abs(std::log(a.spread[d] / b.spread[d])) / 3;
            means += std::abs(a.mean[d] - b.mean[d]) / b.spread[d] / 3;
        }
        chances += std::abs(learned.probability() - planted.probability());
    }
    const double count = static_cast<double>(samples.cases.size());
    EXPECT_LT(spreads / count, 0.10);
    EXPECT_LT(means / count, 0.25);
    EXPECT_LT(chances / count, 0.03);
}

TEST(OwnPoses, OfAnotherClassOfLocaliserTheErrorsAreCalibrated) {
    const std::vector<Log> logs = referenceLogs(40, 1);
    const SensorSummary found = summariseSensor(logs, "localisation", {});
    ASSERT_TRUE(found.lateness.identified) << found.lateness.reason;
    EXPECT_NEAR(found.lateness.lateness, 0.1, 0.01);
    const SensorSamples samples = sensorSamples(logs, samplingOf(found));
    const auto trained = trainSensor(blueprintOf(found), samples, quick(3));
    ASSERT_TRUE(trained) << trained.error().message();
    const Calibration calibration(LearnedSensor(*trained), sensorSamples(referenceLogs(40, 2), samplingOf(found)),
                                  constantNoise(samples, *trained));
    RecordProperty("log_likelihood", std::to_string(calibration.likelihood));
    RecordProperty("constant", std::to_string(calibration.ofConstant));
    EXPECT_GT(calibration.likelihood, calibration.ofConstant + 0.05);
    EXPECT_NEAR(calibration.readings / calibration.expected, 1, 0.02);
    for (std::size_t d = 0; d < 3; ++d) {
        RecordProperty("half_" + std::to_string(d), std::to_string(calibration.half[d]));
        RecordProperty("nearly_all_" + std::to_string(d), std::to_string(calibration.nearlyAll[d]));
        EXPECT_NEAR(calibration.half[d], 0.5, 0.05) << d;
        EXPECT_NEAR(calibration.nearlyAll[d], 0.9, 0.03) << d;
    }
}

TEST(OwnPoses, GarbledReportsDoNotChangePredictions) {
    const std::vector<Log> logs = referenceLogs(1, 3);
    std::vector<Log> garbled = referenceLogs(1, 3);
    for (StampedPose& reported : garbled[0].robots[0].trajectories[0].sensors[0].poses)
        reported.pose = {1e3 * uniformNoise({1, reported.time, 0, 0}), -7, 3};
    SensorSampleOptions options{.sensor = "localisation", .measures = SensorNetwork::Measures::pose};
    options.period = 100 * millisecond;
    const SensorSamples a = sensorSamples(logs, options), b = sensorSamples(garbled, options);
    ASSERT_EQ(a.cases.size(), b.cases.size());
    for (std::size_t i = 0; i < a.cases.size(); ++i) {
        EXPECT_EQ(a.cases[i].state.own, b.cases[i].state.own);
        EXPECT_EQ(a.cases[i].state.velocity.v, b.cases[i].state.velocity.v);
        EXPECT_EQ(a.cases[i].state.velocity.w, b.cases[i].state.velocity.w);
        EXPECT_EQ(a.cases[i].reported, b.cases[i].reported);
    }
}

TEST(PooledLateness, WeighsByStandardErrors) {
    const std::vector<SensorLateness> each{{true, {}, 0.10, 0.01}, {true, {}, 0.16, 0.02}, {false, "none", 9, 9}};
    const SensorLateness pooled = pooledLateness(each);
    EXPECT_TRUE(pooled.identified);
    EXPECT_NEAR(pooled.lateness, 0.112, 1e-12);
    // they disagree by more than their errors: (0.06 s)^2 / (0.01^2 + 0.02^2) is 7.2
    EXPECT_NEAR(pooled.error, std::sqrt(7.2 / 12'500), 1e-12);
    EXPECT_EQ(pooledLateness(std::span(each).last(1)).reason, "none");
    EXPECT_FALSE(pooledLateness({}).identified);
}

}  // namespace
}  // namespace mrose
