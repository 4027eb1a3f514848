#include "identification/path_fit.h"

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

/// x(t): 2 m/s slowed down by 3 m/s2 for 0.3 s, then by 0.4; y likewise, half as fast.
TrackedPoint planted(double time, double noise, std::int64_t draw) {
    const double early = std::min(time, 0.3), late = std::max(0.0, time - 0.3);
    const double way = 2 * time - 3 * (early * early / 2 + early * late) - 0.4 * late * late / 2;
    const NoisePair n = normalPair({7, draw, 0, 0});
    return {time, {1 + way + noise * n.first, 2 + way / 2 + noise * n.second}};
}

std::vector<TrackedPoint> plantedTrack(double noise, std::int64_t seed) {
    std::vector<TrackedPoint> points;
    for (int i = 0; i < 50; ++i) points.push_back(planted(0.02 * i, noise, 1000 * seed + i));
    return points;
}

TEST(PathFit, FindsAChangeExactlyWithoutNoise) {
    const auto fit = fitChangingPath(plantedTrack(0, 0), 1e-6);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->parameters[PathFit::change], 0.3, 1e-4);
    EXPECT_NEAR(fit->parameters[PathFit::velocity], 2, 1e-4);
    EXPECT_NEAR(fit->parameters[PathFit::first], -3, 1e-3);
    EXPECT_NEAR(fit->parameters[PathFit::second + 1], -0.2, 1e-3);
    EXPECT_NEAR(fit->velocityAt(0.5).x, 2 - 0.9 - 0.08, 1e-4);
    EXPECT_NEAR(fit->placeAt(0.9).y, planted(0.9, 0, 0).place.y, 1e-5);
}

TEST(PathFit, ErrorsAreThoseThatRepetitionsShow) {
    double within = 0, squares = 0, predicted = 0;
    constexpr int runs = 200;
    for (int seed = 1; seed <= runs; ++seed) {
        const auto fit = fitChangingPath(plantedTrack(0.002, seed), 0.002);
        ASSERT_TRUE(fit);
        const auto kept = [&](const PathFit::Parameters& p) {
            return length(fit->velocityAt(p, p[PathFit::change])) / length(fit->velocityAt(p, 0));
        };
        const double off = kept(fit->parameters) - 0.55, error = fit->errorOf(kept);
        within += std::abs(off) < error ? 1.0 / runs : 0;
        squares += off * off / runs;
        predicted += error * error / runs;
    }
    EXPECT_NEAR(within, 0.68, 0.1);
    EXPECT_NEAR(std::sqrt(squares / predicted), 1, 0.15);
}

TEST(PathFit, AnEvenPathHasNoChange) {
    std::vector<TrackedPoint> points;
    for (int i = 0; i < 50; ++i) {
        const double t = 0.02 * i;
        const NoisePair n = normalPair({8, i, 0, 0});
        points.push_back({t, {t - 0.2 * t * t + 0.002 * n.first, 0.002 * n.second}});
    }
    EXPECT_FALSE(fitChangingPath(points, 0.002));
    const auto fit = fitEvenPath(points, 0.002);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->parameters[PathFit::first], -0.4, 0.03);
    EXPECT_FALSE(fitEvenPath(std::span(points).first(3), 0.002));
    EXPECT_FALSE(fitChangingPath(std::span(points).first(8), 0.002));
}

}  // namespace
}  // namespace mrose
