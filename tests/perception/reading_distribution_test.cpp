#include "perception/reading_distribution.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr ReadingForm form{2, 2};
const GrossErrors gross{0.05, {1.5, 0.5}};

/// Reported in 30 % of cases; a narrow component and a wide one beside it.
std::vector<double> someValues() {
    std::vector<double> values(static_cast<std::size_t>(form.outputs()));
    values[ReadingForm::reported] = normalQuantile(0.3);
    const auto set = [&](int i, double value) { values[static_cast<std::size_t>(ReadingForm::errors + i)] = value; };
    set(form.errorOf(0, 0), 0.1);
    set(form.spreadOf(0, 0), std::log(0.2));
    set(form.errorOf(0, 1), -0.02);
    set(form.spreadOf(0, 1), std::log(0.03));
    set(form.shareOf(1), std::log(0.5));
    set(form.errorOf(1, 0), -0.3);
    set(form.spreadOf(1, 0), std::log(0.4));
    set(form.errorOf(1, 1), 0.05);
    set(form.spreadOf(1, 1), std::log(0.1));
    return values;
}
ReadingDistribution some() { return ReadingDistribution::of(form, someValues(), gross); }

ReadingDraw draw(std::int64_t i) {
    const NoisePair a = normalPair({5, i, 0, 0}), b = normalPair({5, i, 0, 1});
    return {a.first, uniformNoise({5, i, 0, 2}), {b.first, b.second}};
}

TEST(ReadingDistributions, SharesAndProbabilitiesAreThoseOfTheValues) {
    const ReadingDistribution d = some();
    EXPECT_NEAR(d.probability(), 0.3, 1e-12);
    EXPECT_NEAR(d.component[0].share, 2.0 / 3, 1e-12);
    EXPECT_NEAR(d.component[1].share, 1.0 / 3, 1e-12);
    EXPECT_NEAR(d.component[1].spread[0], 0.4, 1e-12);
    EXPECT_NEAR(d.mean(0), 0.95 * (2 * 0.1 - 0.3) / 3, 1e-12);
}

TEST(ReadingDistributions, DensityIntegratesToProbabilities) {
    const ReadingDistribution d = some();
    constexpr int n = 1200;
    constexpr double width = 3, height = 1;  // half of what is integrated over
    double whole = 0, mean = 0, square = 0, below = 0;
    const double cell = 4 * width * height / n / n;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < n; ++k) {
            const double x = width * (2 * (i + 0.5) / n - 1), y = height * (2 * (k + 0.5) / n - 1);
            const double density = d.density({x, y}) * cell;
            whole += density;
            mean += density * x;
            square += density * x * x;
            if (x < -0.25) below += density;
        }
    EXPECT_NEAR(whole, 1, 1e-4);
    EXPECT_NEAR(mean, d.mean(0), 1e-4);
    EXPECT_NEAR(std::sqrt(square - mean * mean), d.deviation(0), 1e-4);
    EXPECT_NEAR(below, d.probabilityBelow(0, -0.25), 1e-3);
}

/// Of two members: the second is off by as much as the first.
ReadingDistribution ofTwoMembers() {
    std::vector<double> values = someValues();
    const std::vector<double> first(values.begin() + ReadingForm::errors, values.end());
    values.insert(values.end(), first.begin(), first.end());
    for (int k = 0; k < form.components; ++k)
        values[static_cast<std::size_t>(ReadingForm::errors + form.memberOutputs() + form.errorOf(k, 0))] += 0.7;
    return ReadingDistribution::of({2, 2, 2}, values, gross);
}

TEST(ReadingDistributions, EachMemberHasAnEqualShare) {
    const ReadingDistribution one = some(), both = ofTwoMembers();
    EXPECT_EQ(both.components().size(), 4u);
    EXPECT_NEAR(both.mean(0), one.mean(0) + 0.95 * 0.35, 1e-12);
    for (const ReadingError& error : {ReadingError{0.2, 0.01}, {0.7, -0.1}}) {
        const double even = 0.05 * gross.density(2);
        EXPECT_NEAR(both.density(error) - even,
                    0.5 * (one.density(error) + one.density({error[0] - 0.7, error[1]})) - even, 1e-12);
    }
}

TEST(ReadingDistributions, DrawsAreOfTheirDensities) {
    for (const ReadingDistribution& d : {some(), ofTwoMembers()}) {
        constexpr int n = 40000;
        int reported = 0;
        std::array<std::vector<double>, 2> errors;
        for (int i = 0; i < n; ++i) {
            reported += d.reports(draw(i));
            const ReadingError error = d.error(draw(i));
            for (std::size_t k = 0; k < 2; ++k) errors[k].push_back(error[k]);
        }
        EXPECT_NEAR(reported / double(n), 0.3, 4 * std::sqrt(0.21 / n));
        for (int k = 0; k < 2; ++k) {
            std::vector<double>& sorted = errors[static_cast<std::size_t>(k)];
            std::sort(sorted.begin(), sorted.end());
            double distance = 0;  // Kolmogorov and Smirnov's
            for (int i = 0; i < n; ++i) {
                const double below = d.probabilityBelow(k, sorted[static_cast<std::size_t>(i)]);
                distance = std::max(distance, std::abs(below - (i + 0.5) / n));
            }
            EXPECT_LT(distance, 1.63 / std::sqrt(n)) << "1 % of such samples are farther off";
        }
    }
}

TEST(ReadingDistributions, GrossErrorsAreWithinReachAndAsManyAsSaid) {
    std::vector<double> values = someValues();
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 2; ++i)
            values[static_cast<std::size_t>(ReadingForm::errors + form.spreadOf(k, i))] = std::log(1e-3);
    const ReadingDistribution d = ReadingDistribution::of(form, values, gross);
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const ReadingError error = d.error(draw(i));
        EXPECT_LE(std::abs(error[0]), 1.5);
        EXPECT_LE(std::abs(error[1]), 0.5);
        wrong += std::min(std::abs(error[0] - 0.1), std::abs(error[0] + 0.3)) > 0.01;
    }
    EXPECT_NEAR(wrong / 20000.0, 0.05, 0.007);
}

TEST(ReadingDistributions, LossesAreLogarithmsOfLikelihoods) {
    const ReadingDistribution d = some();
    double slope = 0;
    EXPECT_NEAR(reportLoss(d.threshold, true, &slope), -std::log(0.3), 1e-12);
    EXPECT_NEAR(reportLoss(d.threshold, false, &slope), -std::log(0.7), 1e-12);
    std::vector<double> gradient(static_cast<std::size_t>(form.memberOutputs()));
    for (const ReadingError& error : {ReadingError{0.2, 0.01}, {-0.5, 0.2}, {1.4, -0.45}, {5, 0.1}})
        EXPECT_NEAR(errorLoss(form, someValues().data() + ReadingForm::errors, gross, error, gradient.data()),
                    -std::log(d.density(error)), 1e-9);
}

/// A component that is out of the question, and one that lies far off.
TEST(ReadingDistributions, LossIsFiniteFarOut) {
    std::vector<double> values = someValues();
    values.erase(values.begin());
    std::vector<double> gradient(values.size());
    const auto at = [&](int i) -> double& { return values[static_cast<std::size_t>(i)]; };
    const ReadingError near{0.1, -0.02};
    at(form.shareOf(1)) = -2000;
    const double alone = errorLoss(form, values.data(), gross, near, gradient.data());
    const double even = 0.05 * gross.density(2), peak = 1 / (2 * std::numbers::pi * 0.2 * 0.03);
    EXPECT_NEAR(alone, -std::log(0.95 * peak + even), 1e-9);
    EXPECT_NEAR(gradient[static_cast<std::size_t>(form.shareOf(1))], 0, 1e-300);
    at(form.shareOf(1)) = 2000;
    at(form.errorOf(1, 0)) = 100;
    EXPECT_NEAR(errorLoss(form, values.data(), gross, near, gradient.data()), -std::log(even), 1e-9)
        << "nothing but a gross error";
    const ReadingError beyond{1e4, 0};
    const double far = errorLoss(form, values.data(), gross, beyond, gradient.data());
    const double z = (1e4 - 100) / 0.4, sideways = 0.05 / 0.1;
    EXPECT_NEAR(far, 0.5 * z * z + 0.5 * sideways * sideways - std::log(0.95 / (2 * std::numbers::pi * 0.4 * 0.1)),
                1e-4);
    for (const double slope : gradient) EXPECT_TRUE(std::isfinite(slope));
}

TEST(ReadingDistributions, GradientsAreThoseOfFiniteDifferences) {
    std::vector<double> values = someValues();
    values.erase(values.begin());
    std::vector<double> gradient(values.size()), ignored(values.size());
    constexpr double step = 1e-5;
    for (const ReadingError& error : {ReadingError{0.2, 0.01}, {-0.5, 0.2}, {1.4, -0.45}, {5, 0.1}}) {
        errorLoss(form, values.data(), gross, error, gradient.data());
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double kept = values[i];
            values[i] = kept + step;
            const double above = errorLoss(form, values.data(), gross, error, ignored.data());
            values[i] = kept - step;
            const double below = errorLoss(form, values.data(), gross, error, ignored.data());
            values[i] = kept;
            EXPECT_NEAR(gradient[i], (above - below) / (2 * step), 1e-5 * std::max(1.0, std::abs(gradient[i]))) << i;
        }
    }
    for (const double threshold : {-6.0, -1.0, 0.3, 4.0})
        for (const bool reported : {false, true}) {
            double slope = 0, other = 0;
            reportLoss(threshold, reported, &slope);
            const double above = reportLoss(threshold + step, reported, &other);
            const double below = reportLoss(threshold - step, reported, &other);
            EXPECT_NEAR(slope, (above - below) / (2 * step), 1e-6 * std::max(1.0, std::abs(slope)));
        }
}

}  // namespace
}  // namespace mrose
