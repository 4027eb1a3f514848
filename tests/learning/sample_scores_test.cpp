#include "learning/sample_scores.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "world/noise.h"

namespace mrose {
namespace {

std::vector<Point> scattered(int count, std::uint64_t seed) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) points.push_back({normalNoise({seed, i, 0, 0}), 2 * normalNoise({seed, i, 1, 0})});
    return points;
}

std::vector<double> first(const std::vector<Point>& points) {
    std::vector<double> values;
    for (const Point& point : points) values.push_back(point.x);
    return values;
}

/// The definition: mean distance to what happened, less half the mean distance of two samples.
template <class Values, class Distance>
double defined(const Values& samples, const typename Values::value_type& truth, Distance distance) {
    double errors = 0, spread = 0;
    const auto count = static_cast<double>(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        errors += distance(samples[i], truth) / count;
        for (std::size_t j = 0; j < samples.size(); ++j)
            if (i != j) spread += distance(samples[i], samples[j]) / (count * (count - 1));
    }
    return errors - spread / 2;
}

TEST(SampleScores, AreWhatTheirDefinitionsSay) {
    const auto apart = [](const Point& a, const Point& b) { return std::hypot(a.x - b.x, a.y - b.y); };
    const auto beside = [](double a, double b) { return std::abs(a - b); };
    for (const int count : {2, 3, 8, 31}) {
        const auto points = scattered(count, 5);
        EXPECT_NEAR(energyScore(points, {0.3, -1}), defined(points, Point{0.3, -1}, apart), 1e-10);
        EXPECT_NEAR(rankedScore(first(points), 0.3), defined(first(points), 0.3, beside), 1e-12);
    }
}

/// Opposite pairs are farther apart than two samples: with them wide forecasts would seem right.
TEST(SampleScores, OfAntitheticSamplesLeaveOppositePairsOut) {
    const auto half = scattered(4, 5);
    std::vector<Point> points = half;
    for (const Point& point : half) points.push_back({-point.x, -point.y});
    const std::vector<double> values = first(points);
    double errors = 0, spread = 0, nearness = 0, width = 0;
    for (std::size_t i = 0; i < 8; ++i) {
        errors += std::hypot(points[i].x - 0.3, points[i].y + 1) / 8;
        nearness += std::abs(values[i] - 0.3) / 8;
        for (std::size_t j = 0; j < 8; ++j) {
            if (i % 4 == j % 4) continue;
            spread += std::hypot(points[i].x - points[j].x, points[i].y - points[j].y) / (8 * 6);
            width += std::abs(values[i] - values[j]) / (8 * 6);
        }
    }
    EXPECT_NEAR(energyScore(points, {0.3, -1}, 1, {}, true), errors - spread / 2, 1e-10);
    EXPECT_NEAR(rankedScore(values, 0.3, 1, {}, true), nearness - width / 2, 1e-12);
}

TEST(SampleScores, OfOneSampleAreItsDistance) {
    EXPECT_NEAR(energyScore(std::vector<Point>{{1, 2}}, {4, 6}), 5, 1e-10);
    EXPECT_EQ(rankedScore(std::vector<double>{1}, 4), 3);
}

class SampleScoresOf : public testing::TestWithParam<bool> {};

TEST_P(SampleScoresOf, HaveTheDerivativesThatCentralDifferencesGive) {
    const bool antithetic = GetParam();
    const int count = antithetic ? 8 : 9;
    auto points = scattered(count, 6);
    auto values = first(points);
    std::vector<Point> byPoint(points.size(), {1, 1});
    std::vector<double> byValue(points.size(), 1);
    energyScore(points, {0.5, 0.5}, 3, byPoint, antithetic);
    rankedScore(values, 0.25, 3, byValue, antithetic);
    const double step = 1e-6;
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (double Point::*part : {&Point::x, &Point::y}) {
            const double at = points[i].*part;
            points[i].*part = at + step;
            const double above = energyScore(points, {0.5, 0.5}, 1, {}, antithetic);
            points[i].*part = at - step;
            const double below = energyScore(points, {0.5, 0.5}, 1, {}, antithetic);
            points[i].*part = at;
            EXPECT_NEAR(byPoint[i].*part, 1 + 3 * (above - below) / (2 * step), 1e-7);
        }
        const double at = values[i];
        values[i] = at + step;
        const double above = rankedScore(values, 0.25, 1, {}, antithetic);
        values[i] = at - step;
        const double below = rankedScore(values, 0.25, 1, {}, antithetic);
        values[i] = at;
        EXPECT_NEAR(byValue[i], 1 + 3 * (above - below) / (2 * step), 1e-7);
    }
}

INSTANTIATE_TEST_SUITE_P(Samples, SampleScoresOf, testing::Bool(),
                         [](const auto& test) { return test.param ? "antithetic" : "independent"; });

/// Forecasts of a normal distribution by samples that are wider or narrower than it: the right ones score best.
TEST(SampleScores, AreLeastForTheRightSpread) {
    const auto mean = [](double width) {
        double energy = 0, ranked = 0;
        for (int i = 0; i < 2000; ++i) {
            std::vector<Point> samples;
            for (const Point& point : scattered(12, 1000 + static_cast<std::uint64_t>(i)))
                samples.push_back({width * point.x, width * point.y});
            const Point truth = scattered(1, 900'000 + static_cast<std::uint64_t>(i)).front();
            energy += energyScore(samples, truth) / 2000;
            ranked += rankedScore(first(samples), truth.x) / 2000;
        }
        return std::pair(energy, ranked);
    };
    const auto [energy, ranked] = mean(1);
    for (const double width : {0.5, 1.7}) {
        EXPECT_GT(mean(width).first, 1.02 * energy);
        EXPECT_GT(mean(width).second, 1.02 * ranked);
    }
    // Of the standard normal distribution: 2 / sqrt(pi) - 1 / sqrt(pi).
    EXPECT_NEAR(ranked, 1 / std::sqrt(3.14159265358979), 0.02);
}

}  // namespace
}  // namespace mrose
