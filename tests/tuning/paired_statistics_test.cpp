#include "tuning/paired_statistics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/elementary.h"
#include "world/noise.h"

namespace mrose {
namespace {

TEST(PairedStatistics, StudentQuantilesAreThoseOfTheTables) {
    // Abramowitz and Stegun, table 26.10.
    const struct {
        double p;
        std::int64_t degrees;
        double t;
    } table[] = {{0.975, 5, 2.571}, {0.975, 7, 2.365}, {0.975, 10, 2.228},  {0.95, 7, 1.895},
                 {0.99, 7, 2.998},  {0.99, 30, 2.457}, {0.975, 120, 1.980}, {0.9, 15, 1.341}};
    for (const auto& [p, degrees, t] : table) EXPECT_NEAR(studentQuantile(p, degrees), t, 0.01 * t) << p << degrees;
}

TEST(PairedStatistics, IntervalsHoldTheMeanAsOftenAsTheySay) {
    constexpr int repeats = 2000;
    int held = 0;
    for (int i = 0; i < repeats; ++i) {
        std::vector<double> values;
        for (std::int64_t k = 0; k < 20; ++k)
            values.push_back(3 + 2 * normalNoise({7, k, static_cast<std::uint32_t>(i), 0}));
        const MeanInterval interval = meanInterval(values);
        held += interval.low <= 3 && 3 <= interval.high ? 1 : 0;
    }
    // Four standard errors of a share of 0.95.
    EXPECT_NEAR(held / static_cast<double>(repeats), 0.95, 4 * std::sqrt(0.95 * 0.05 / repeats));
}

TEST(PairedStatistics, DifferencesGoAsFarAsBoth) {
    const std::vector<double> a{3, 5, 8}, b{1, 1};
    EXPECT_EQ(differences(a, b), (std::vector<double>{2, 4}));
}

TEST(RaceTest, LooksDoubleUntilAllIsRun) {
    EXPECT_EQ(Race(64, true).looks(), (std::vector<std::uint32_t>{8, 16, 32, 64}));
    EXPECT_EQ(Race(50, true).looks(), (std::vector<std::uint32_t>{8, 16, 32, 50}));
    EXPECT_EQ(Race(8, true).looks(), (std::vector<std::uint32_t>{8}));
    EXPECT_EQ(Race(64, false).looks(), (std::vector<std::uint32_t>{64}));
}

/// How often one is dropped whose costs are above the incumbent's by `worse`, with paired noise that `noise` gives.
template <class Noise>
double droppedShare(double worse, const Noise& noise) {
    constexpr int repeats = 4000;
    constexpr std::uint32_t trials = 64;
    const Race race(trials, true);
    int dropped = 0;
    for (std::uint32_t i = 0; i < repeats; ++i) {
        std::vector<double> costs, incumbent;
        bool out = false;
        for (const std::uint32_t look : race.looks()) {
            while (costs.size() < look) {
                const auto trial = static_cast<std::int64_t>(costs.size());
                const double shared = 5 * normalNoise({1, trial, i, 0});  // what makes a trial hard for both
                incumbent.push_back(shared + noise(NoiseKey{2, trial, i, 0}));
                costs.push_back(shared + worse + noise(NoiseKey{3, trial, i, 0}));
            }
            if (look < trials && race.drops(costs, incumbent)) out = true;
            if (out) break;
        }
        dropped += out ? 1 : 0;
    }
    return dropped / static_cast<double>(repeats);
}

double normal(const NoiseKey& key) { return normalNoise(key); }
double skewed(const NoiseKey& key) { return -logarithm(uniformNoise(key)); }
double success(const NoiseKey& key) { return uniformNoise(key) < 0.3 ? 1.0 : 0.0; }

TEST(RaceTest, DropsAnEqualCandidateAsSeldomAsItSays) {
    const double margin = 4 * std::sqrt(Race::falseDrops * (1 - Race::falseDrops) / 4000);
    EXPECT_LE(droppedShare(0, normal), Race::falseDrops + margin);
    EXPECT_LE(droppedShare(0, skewed), Race::falseDrops + margin);
    EXPECT_LE(droppedShare(0, success), Race::falseDrops + margin);
    // Not because it never drops anything.
    EXPECT_GT(droppedShare(0, normal), 0.01);
}

TEST(RaceTest, DropsABadCandidateAndKeepsABetterOne) {
    EXPECT_GT(droppedShare(2, normal), 0.99);
    EXPECT_LT(droppedShare(-0.5, normal), 0.01);
}

TEST(RaceTest, EqualCostsAreNoReason) {
    const std::vector<double> same(8, 1.0), other(8, 2.0);
    const Race race(16, true);
    EXPECT_FALSE(race.drops(same, same));
    EXPECT_FALSE(race.drops(same, other));
    EXPECT_TRUE(race.drops(other, same));
}

}  // namespace
}  // namespace mrose
