#include "identification/rollout_loss.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

std::vector<Pose> arbitraryIncrements(std::uint64_t seed, int count) {
    std::vector<Pose> increments;
    for (int i = 0; i < count; ++i)
        increments.push_back({0.01 * normalNoise({seed, i, 0, 0}), 0.002 * normalNoise({seed, i, 1, 0}),
                              0.2 * normalNoise({seed, i, 2, 0})});
    return increments;
}

TEST(RolloutLoss, IsTheMeanDistanceAndAngleOfTheComposedPoses) {
    const auto predicted = arbitraryIncrements(1, 7), truth = arbitraryIncrements(2, 7);
    RolloutLoss loss;
    loss.positionRounding = loss.headingRounding = 0;
    Pose p, q;
    double expected = 0;
    for (std::size_t k = 0; k < 7; ++k) {
        p = p * predicted[k];
        q = q * truth[k];
        expected += (std::hypot(p.x - q.x, p.y - q.y) + loss.headingWeight * std::abs(p.heading - q.heading)) / 7;
    }
    std::vector<Pose> gradient(7);
    EXPECT_NEAR(loss(predicted, truth, gradient), expected, 1e-15);
}

TEST(RolloutLoss, GradientEqualsCentralDifferences) {
    auto predicted = arbitraryIncrements(3, 9);
    const auto truth = arbitraryIncrements(4, 9);
    const RolloutLoss loss;
    std::vector<Pose> gradient(9), unused(9);
    loss(predicted, truth, gradient);
    const double step = 1e-6;
    for (std::size_t k = 0; k < 9; ++k)
        for (double Pose::*part : {&Pose::x, &Pose::y, &Pose::heading}) {
            const double value = predicted[k].*part;
            predicted[k].*part = value + step;
            const double above = loss(predicted, truth, unused);
            predicted[k].*part = value - step;
            const double below = loss(predicted, truth, unused);
            predicted[k].*part = value;
            EXPECT_NEAR(gradient[k].*part, (above - below) / (2 * step), 1e-7);
        }
}

TEST(RolloutLoss, AddsToTheGradient) {
    const auto predicted = arbitraryIncrements(5, 3), truth = arbitraryIncrements(6, 3);
    std::vector<Pose> once(3), twice(3);
    const RolloutLoss loss;
    loss(predicted, truth, once);
    loss(predicted, truth, twice);
    loss(predicted, truth, twice);
    EXPECT_DOUBLE_EQ(twice[0].x, 2 * once[0].x);
}

}  // namespace
}  // namespace mrose
