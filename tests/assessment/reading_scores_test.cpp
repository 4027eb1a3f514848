#include "assessment/reading_scores.h"

#include <cmath>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

ReadingDistribution mixture() {
    ReadingDistribution of;
    of.form.components = 3;
    of.component[0] = {0.5, {0.1, 0.0}, {0.05, 0.01}};
    of.component[1] = {0.3, {-0.2, 0.02}, {0.2, 0.03}};
    of.component[2] = {0.2, {0.4, -0.05}, {0.02, 0.001}};
    return of;
}

ReadingDistribution withGross() {
    ReadingDistribution of = mixture();
    of.gross = {0.1, {2, 0.5}};
    return of;
}

/// The integral of (F(x) - [x > error])^2, by the trapezoidal rule on both sides of the error.
double integratedScore(const ReadingDistribution& of, int dimension, double error) {
    const double reach = dimension == 0 ? 4 : 1;
    constexpr int steps = 40'000;
    double sum = 0;
    for (const double end : {-reach, reach}) {
        const double step = std::abs(end - error) / steps;
        for (int i = 0; i <= steps; ++i) {
            const double below = of.probabilityBelow(dimension, error + (end - error) * i / steps);
            const double miss = end < error ? below : 1 - below;
            sum += (i == 0 || i == steps ? 0.5 : 1) * step * miss * miss;
        }
    }
    return sum;
}

TEST(RankedProbabilityScore, IsTheIntegralOfSquaredDifferencesOfDistributions) {
    for (const ReadingDistribution& of : {mixture(), withGross()})
        for (const int dimension : {0, 1})
            for (const double error : {-0.6, -0.05, 0.0, 0.1, 0.45})
                EXPECT_NEAR(rankedProbabilityScore(of, dimension, error), integratedScore(of, dimension, error), 2e-6)
                    << dimension << ' ' << error;
}

TEST(RankedProbabilityScore, IsWhatTheFairEstimatorOfSamplesTendsTo) {
    const ReadingDistribution of = withGross();
    constexpr int count = 40'000;
    std::vector<double> samples;
    for (int i = 0; i < count; ++i) {
        const NoisePair normals = normalPair({1, i, 0, 0});
        samples.push_back(of.error({0, uniformNoise({1, i, 0, 1}), {normals.first, normals.second}})[0]);
    }
    std::sort(samples.begin(), samples.end());
    const double error = 0.3;
    double toError = 0, apart = 0;
    for (int i = 0; i < count; ++i) {
        toError += std::abs(samples[static_cast<std::size_t>(i)] - error) / count;
        apart += samples[static_cast<std::size_t>(i)] * (2.0 * (i + 1) - count - 1) / count / (count - 1);
    }
    EXPECT_NEAR(rankedProbabilityScore(of, 0, error), toError - apart, 0.004);
}

TEST(RankedProbabilityScore, OfAPointIsTheAbsoluteError) {
    ReadingDistribution point;
    point.component[0] = {1, {0.2, 0}, {1e-9, 1e-9}};
    EXPECT_NEAR(rankedProbabilityScore(point, 0, 0.5), 0.3, 1e-8);
    EXPECT_NEAR(rankedProbabilityScore(point, 1, -0.25), 0.25, 1e-8);
}

TEST(ErrorQuantile, HasItsShareBelow) {
    for (const ReadingDistribution& of : {mixture(), withGross()})
        for (const double share : {0.001, 0.05, 0.25, 0.5, 0.9, 0.999})
            EXPECT_NEAR(of.probabilityBelow(0, errorQuantile(of, 0, share)), share, 2e-6) << share;
    ReadingDistribution normal;
    normal.component[0].spread = {2, 1};
    EXPECT_NEAR(errorQuantile(normal, 0, 0.975), 2 * 1.959964, 1e-6);
}

}  // namespace
}  // namespace mrose
