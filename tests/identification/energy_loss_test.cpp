#include "identification/energy_loss.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "learning/sample_scores.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr std::size_t chainLength = 8, sampleCount = 5;

std::vector<Pose> arbitraryMotion(std::uint64_t seed, std::size_t periods) {
    std::vector<Pose> increments;
    for (std::size_t i = 0; i < periods; ++i) {
        const auto k = static_cast<std::int64_t>(i);
        increments.push_back({0.05 + 0.02 * normalNoise({seed, k, 0, 0}), 0.01 * normalNoise({seed, k, 1, 0}),
                              0.3 * normalNoise({seed, k, 2, 0})});
    }
    return increments;
}

/// Of three instants, each with other weights.
EnergyLoss lossOf(std::vector<std::size_t> instants) {
    return {std::move(instants), {{1, 0.35, 0.7}, {0.5, 0.6, 3}, {2, 0.1, 0}}};
}

/// Where increments `begin` to `end` of a sample lead.
Pose composed(const std::vector<Pose>& increments, std::size_t begin, std::size_t end) {
    Pose pose;
    for (std::size_t k = begin; k < end; ++k) pose = pose * increments[k];
    return pose;
}

TEST(EnergyLoss, IsTheSumOfItsScores) {
    const auto samples = arbitraryMotion(1, sampleCount * chainLength), truth = arbitraryMotion(2, chainLength);
    EnergyLoss loss = lossOf({2, 5, 8});
    double expected = 0;
    const auto places = [&](std::size_t begin, std::size_t end) {
        std::vector<Point> all;
        for (std::size_t s = 0; s < sampleCount; ++s) {
            const Pose pose = composed(samples, s * chainLength + begin, s * chainLength + end);
            all.push_back({pose.x, pose.y});
        }
        const Pose real = composed(truth, begin, end);
        return energyScore(all, {real.x, real.y});
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = loss.instants[i];
        std::vector<double> headings;
        for (std::size_t s = 0; s < sampleCount; ++s)
            headings.push_back(composed(samples, s * chainLength, s * chainLength + k).heading);
        expected += loss.weights[i].place * places(0, k) +
                    loss.weights[i].heading * rankedScore(headings, composed(truth, 0, k).heading);
    }
    expected += 0.7 * places(2, 5) + 3 * places(5, 8);
    const auto mean = arbitraryMotion(7, chainLength);
    loss.axisWeight = 0;
    EXPECT_NEAR(loss(samples, sampleCount, mean, truth, {}), expected, 1e-12);
    // Along and across the mean's heading at each instant.
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = loss.instants[i];
        const double heading = composed(mean, 0, k).heading;
        for (const double turned : {heading, heading + 3.14159265358979 / 2}) {
            const auto part = [&](const Pose& pose) { return std::cos(turned) * pose.x + std::sin(turned) * pose.y; };
            std::vector<double> parts;
            for (std::size_t s = 0; s < sampleCount; ++s)
                parts.push_back(part(composed(samples, s * chainLength, s * chainLength + k)));
            expected += 0.2 * loss.weights[i].place * rankedScore(parts, part(composed(truth, 0, k)));
        }
    }
    loss.axisWeight = 0.2;
    EXPECT_NEAR(loss(samples, sampleCount, mean, truth, {}), expected, 1e-12);
}

TEST(EnergyLoss, AddsTheGradientThatCentralDifferencesGive) {
    auto samples = arbitraryMotion(3, sampleCount * chainLength);
    const auto truth = arbitraryMotion(4, chainLength), mean = arbitraryMotion(8, chainLength);
    const EnergyLoss loss = lossOf({1, 4, 8});
    std::vector<Pose> gradient(samples.size(), {1, 1, 1});
    loss(samples, sampleCount, mean, truth, gradient);
    const double step = 1e-6;
    for (std::size_t i = 0; i < samples.size(); ++i)
        for (double Pose::*part : {&Pose::x, &Pose::y, &Pose::heading}) {
            const double value = samples[i].*part;
            samples[i].*part = value + step;
            const double above = loss(samples, sampleCount, mean, truth, {});
            samples[i].*part = value - step;
            const double below = loss(samples, sampleCount, mean, truth, {});
            samples[i].*part = value;
            EXPECT_NEAR(gradient[i].*part, 1 + (above - below) / (2 * step), 1e-7) << i;
        }
}

TEST(EnergyLoss, JudgesFourInstantsOrThoseThatThereAre) {
    EXPECT_EQ(EnergyLoss::over(100).instants, (std::vector<std::size_t>{10, 20, 50, 100}));
    EXPECT_EQ(EnergyLoss::over(100).weights.size(), 4u);
    EXPECT_EQ(EnergyLoss::over(4).instants, (std::vector<std::size_t>{1, 2, 4}));
    EXPECT_EQ(EnergyLoss::over(1).instants, (std::vector<std::size_t>{1}));
}

}  // namespace
}  // namespace mrose
