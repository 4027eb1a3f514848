#include "assessment/localiser_scores.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/normal_distribution.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr ReadingError spreads{0.1, 0.2, 0.03};
constexpr double reported = 0.8;

/// Normal errors about 0, whatever is true.
class NormalLocaliser final : public SensorModel {
public:
    explicit NormalLocaliser(double factor = 1) : factor_(factor) {}
    Nanoseconds latency() const override { return 0; }
    View view() const override { return {}; }
    void distributions(std::span<const SensedState> states, const std::string&,
                       std::span<ReadingDistribution> to) const override {
        for (std::size_t i = 0; i < states.size(); ++i) {
            to[i].form = {3, 1, 1};
            to[i].threshold = normalQuantile(reported);
            for (std::size_t d = 0; d < 3; ++d) to[i].component[0].spread[d] = factor_ * spreads[d];
            to[i].component[0].share = 1;
        }
    }

private:
    double factor_;
};

std::vector<LocaliserCase> drawnCases(int count) {
    std::vector<LocaliserCase> cases;
    for (int i = 0; i < count; ++i) {
        LocaliserCase& one = cases.emplace_back();
        one.robot = "r";
        one.reported = one.sound = uniformNoise({5, i, 0, 0}) < reported;
        for (std::uint32_t d = 0; d < 3; ++d) one.error[d] = spreads[d] * normalNoise({5, i, 1, d});
    }
    return cases;
}

TEST(LocaliserScores, OfTheDistributionThatItIsAreThoseOfAPerfectForecast) {
    const std::vector<LocaliserCase> cases = drawnCases(20'000);
    const LocaliserScores scores = scoreLocaliser("true", NormalLocaliser(), cases);
    EXPECT_EQ(scores.cases, cases.size());
    EXPECT_NEAR(static_cast<double>(scores.readings) / 20'000, reported, 0.01);
    EXPECT_EQ(scores.sound, scores.readings);
    double entropy = 0;
    for (std::size_t d = 0; d < 3; ++d) {
        // of a normal distribution: its spread over the root of pi
        EXPECT_NEAR(scores.error[d].crps, spreads[d] / std::sqrt(std::numbers::pi), 0.02 * spreads[d]);
        EXPECT_NEAR(scores.error[d].rmse, spreads[d], 0.02 * spreads[d]);
        EXPECT_NEAR(scores.error[d].inside50, 0.5, 0.02);
        EXPECT_NEAR(scores.error[d].inside90, 0.9, 0.01);
        std::size_t all = 0;
        for (const std::size_t count : scores.below[d]) {
            EXPECT_NEAR(static_cast<double>(count), static_cast<double>(scores.sound) / 20, 110);
            all += count;
        }
        EXPECT_EQ(all, scores.sound);
        entropy += 0.5 * std::log(2 * std::numbers::pi * std::numbers::e * spreads[d] * spreads[d]);
    }
    EXPECT_NEAR(scores.logDensity, -entropy, 0.03);
    EXPECT_NEAR(scores.detection, reported * std::log(reported) + (1 - reported) * std::log(1 - reported), 0.01);
}

/// Of robots with biases of their own, which it knows.
class BiasedLocaliser final : public SensorModel {
public:
    Nanoseconds latency() const override { return 0; }
    View view() const override { return {}; }
    void distributions(std::span<const SensedState> states, const std::string& robot,
                       std::span<ReadingDistribution> to) const override {
        NormalLocaliser().distributions(states, robot, to);
        for (ReadingDistribution& one : to) one.component[0].mean[0] = robot == "r" ? 0.3 : -0.1;
    }
};

TEST(LocaliserScores, BelowAndMissAreFromTheMedianOfTheRobotThatReports) {
    std::vector<LocaliserCase> cases(4);
    for (LocaliserCase& one : cases) one.robot = "r", one.reported = one.sound = true;
    cases[3].robot = "other";
    const double upper = 0.6745 * spreads[0];  // three quarters lie below
    for (const std::size_t i : {0u, 1u, 2u}) cases[i].error[0] = 0.3 + 1.01 * upper;
    cases[3].error[0] = -0.1 + 1.01 * upper;
    const LocaliserScores scores = scoreLocaliser("biased", BiasedLocaliser(), cases);
    EXPECT_EQ(scores.below[0][15], 4u);
    EXPECT_NEAR(scores.error[0].rmse, 1.01 * upper, 1e-6);
}

TEST(LocaliserScores, OfOneThatIsTooSureAreWorse) {
    const std::vector<LocaliserCase> cases = drawnCases(5'000);
    const LocaliserScores right = scoreLocaliser("right", NormalLocaliser(), cases),
                          sure = scoreLocaliser("sure", NormalLocaliser(0.5), cases);
    for (std::size_t d = 0; d < 3; ++d) {
        EXPECT_GT(sure.error[d].crps, 1.02 * right.error[d].crps);
        EXPECT_NEAR(sure.error[d].inside90, std::erf(0.5 * 1.6449 / std::sqrt(2.0)), 0.02);
    }
    EXPECT_LT(sure.logDensity, right.logDensity - 1);
}

TEST(LocaliserScores, OfAnIdealOneAreItsErrors) {
    SensorNetwork like;
    like.measures = SensorNetwork::Measures::pose;
    like.form = {3, 1, 1};
    like.constant.seen = reported;
    like.constant.spread = spreads;
    std::vector<LocaliserCase> cases = drawnCases(2'000);
    using Noise = IdealSensorModel::Noise;
    const LocaliserScores exact = scoreLocaliser("ideal", IdealSensorModel(like, Noise::none), cases),
                          noisy = scoreLocaliser("noisy", IdealSensorModel(like, Noise::constant), cases),
                          own = scoreLocaliser("own", NormalLocaliser(), cases);
    double sum = 0;
    for (LocaliserCase& one : cases) sum += one.sound ? std::abs(one.error[1]) : 0;
    EXPECT_NEAR(exact.error[1].crps, sum / static_cast<double>(exact.sound), 1e-6);
    EXPECT_TRUE(std::isnan(exact.logDensity));
    EXPECT_NEAR(noisy.error[2].crps, own.error[2].crps, 1e-9);
    EXPECT_NEAR(noisy.detection, own.detection, 1e-9);
    // Gross errors count as reports alone.
    for (LocaliserCase& one : cases)
        if (one.error[0] > 0.1) one.sound = false, one.error = {99, 99, 3};
    const LocaliserScores without = scoreLocaliser("own", NormalLocaliser(), cases);
    EXPECT_EQ(without.readings, own.readings);
    EXPECT_LT(without.sound, own.sound);
    EXPECT_LT(without.error[0].rmse, own.error[0].rmse);
}

}  // namespace
}  // namespace mrose
