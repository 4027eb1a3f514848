#include "assessment/forecast.h"

#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "assessment/evaluate.h"
#include "assessment/test_models.h"
#include "motion/noisy_model.h"

namespace mrose {
namespace {

constexpr MotionNoise straying{0.3, 0.4, 0.2};

Command roaming(double t) { return {0.2 + 0.1 * std::sin(t), 0.4 * std::cos(0.7 * t)}; }

MotionNoise multiplied(const MotionNoise& noise, double factor) {
    return {factor * noise.distancePerDistance, factor * noise.rotationPerRotation, factor * noise.rotationPerDistance};
}

/// A model that knows its mean, with noise of its own; and the log of a robot that moves like that.
class ForecastTest : public testing::Test {
protected:
    ForecastTest() {
        Trajectory driven = obedientTrajectory(0, 1500 * second, roaming, 10);
        const NoisyModel real(mean_, straying);
        RolloutStart start{&driven, 0, driven.poses.front().pose, StampedVelocity{}, 15000};
        start.seed = 99'991;
        const auto poses = rollOut(real, {&start, 1});
        for (std::size_t k = 0; k < poses->front().size(); ++k) driven.poses[k + 1].pose = poses->front()[k];
        log_ = logOf({driven});
        windows_ = logWindows(log_, *findWindows(log_), {});
    }

    Forecast forecastWith(const MotionNoise& noise, int samples = 40) const {
        const NoisyModel noisy(mean_, noise);
        const SampledModel model{NamedModel::same("noisy", noisy), NamedModel::same("mean", *mean_), 0, samples};
        return forecast(log_, windows_, {&model, 1})->front();
    }

    std::shared_ptr<const MotionModel> mean_ = std::make_shared<const HeldCommandModel>();
    Log log_;
    LogWindows windows_;
};

/// E|X - y| - E|X - X'| / 2, written down once more.
double energyByHand(const std::vector<Point>& samples, const Point& real) {
    double errors = 0, pairs = 0;
    const auto n = static_cast<double>(samples.size());
    for (const Point& a : samples) {
        errors += std::hypot(a.x - real.x, a.y - real.y) / n;
        for (const Point& b : samples) pairs += std::hypot(a.x - b.x, a.y - b.y) / (n * (n - 1));
    }
    return errors - pairs / 2;
}

TEST_F(ForecastTest, ScoresAreThoseOfTheRunsOfEachSample) {
    const NoisyModel noisy(mean_, straying);
    std::vector<RolloutStart> starts = rolloutStarts(log_, windows_.windows);
    std::vector<std::vector<std::vector<Pose>>> runs;
    for (std::uint32_t sample = 0; sample < 8; ++sample) {
        for (RolloutStart& start : starts) start.seed = sampleSeed(1, log_.robots[0].robot, start, sample);
        runs.push_back(*rollOut(noisy, starts));
    }
    const Forecast found = forecastWith(straying, 8);
    ASSERT_EQ(found.at.size(), 4u);
    const std::array<std::size_t, 4> instants{10, 20, 50, 100};
    double moves = 0;
    for (std::size_t i = 0; i < instants.size(); ++i) {
        double energy = 0;
        for (std::size_t w = 0; w < starts.size(); ++w) {
            const auto seenFrom = [&](const Pose& frame, const Pose& pose) {
                const double x = pose.x - frame.x, y = pose.y - frame.y;
                return Point{x * std::cos(frame.heading) + y * std::sin(frame.heading),
                             y * std::cos(frame.heading) - x * std::sin(frame.heading)};
            };
            const std::vector<Pose>& real = windows_.windows[w].truth;
            std::vector<Point> samples, displacements;
            for (const auto& run : runs) {
                samples.push_back(position(run[w][instants[i] - 1]));
                if (i > 0) displacements.push_back(seenFrom(run[w][instants[i - 1] - 1], run[w][instants[i] - 1]));
            }
            energy += energyByHand(samples, position(real[instants[i]]));
            if (i > 0) moves += energyByHand(displacements, seenFrom(real[instants[i - 1]], real[instants[i]]));
        }
        EXPECT_EQ(found.at[i].time, static_cast<Nanoseconds>(instants[i]) * second / 10);
        EXPECT_NEAR(found.at[i].energy, energy / static_cast<double>(starts.size()), 1e-9) << i;
    }
    EXPECT_NEAR(found.moves, moves / static_cast<double>(starts.size()), 1e-9);
}

/// Else what the draws of some samples happen to be would be taken for the noise.
TEST_F(ForecastTest, SamplesOfStartsHaveNothingInCommon) {
    const NoisyModel noisy(mean_, straying);
    Trajectory other = log_.robots[0].trajectories[0];
    other.name = "another";
    std::vector<RolloutStart> starts = rolloutStarts(log_, windows_.windows);
    const std::size_t windows = starts.size();
    for (std::size_t w = 0; w < windows; ++w) {  // at the same time: of another trajectory, and of another robot
        starts.push_back(starts[w]);
        starts.back().trajectory = &other;
        starts.push_back(starts[w]);
    }
    const auto robotOf = [&](std::size_t i) { return i >= windows && (i - windows) % 2 == 1 ? "other" : "r"; };
    std::vector<std::vector<double>> turned(starts.size());
    for (std::uint32_t sample = 0; sample < 16; ++sample) {
        for (std::size_t i = 0; i < starts.size(); ++i) starts[i].seed = sampleSeed(1, robotOf(i), starts[i], sample);
        const auto poses = rollOut(noisy, starts), means = rollOut(*mean_, starts);
        ASSERT_TRUE(poses && means);
        for (std::size_t i = 0; i < starts.size(); ++i)
            turned[i].push_back((*poses)[i].back().heading - (*means)[i].back().heading);
    }
    const auto correlation = [&](auto first, auto second) {
        double products = 0, squares = 0;
        for (std::size_t w = 0; w + 1 < windows; ++w)
            for (std::size_t k = 0; k < turned[w].size(); ++k) {
                const double a = turned[first(w)][k], b = turned[second(w)][k];
                products += a * b;
                squares += (a * a + b * b) / 2;
            }
        return products / squares;
    };
    const double chance = 4 / std::sqrt(16.0 * static_cast<double>(windows - 1));
    const auto itself = [](std::size_t w) { return w; };
    EXPECT_LT(std::abs(correlation(itself, [](std::size_t w) { return w + 1; })), chance);
    EXPECT_LT(std::abs(correlation(itself, [&](std::size_t w) { return windows + 2 * w; })), chance);
    EXPECT_LT(std::abs(correlation(itself, [&](std::size_t w) { return windows + 2 * w + 1; })), chance);
    EXPECT_NEAR(correlation(itself, itself), 1, 1e-12);
}

TEST_F(ForecastTest, WhoKnowsTheNoiseIsCalibratedAndHasTheBestScores) {
    const Forecast right = forecastWith(straying);
    EXPECT_LT(right.miss(), 10) << windows_.windows.size() << " windows";
    for (const double factor : {0.4, 2.5}) {
        const Forecast wrong = forecastWith(multiplied(straying, factor));
        EXPECT_GT(wrong.energy(), 1.02 * right.energy()) << factor;
        EXPECT_GT(wrong.heading(), 1.02 * right.heading()) << factor;
        EXPECT_GT(wrong.moves, 1.02 * right.moves) << factor;
        EXPECT_GT(wrong.miss(), 20) << factor;
        EXPECT_EQ(wrong.at.back().inside(0.9) > right.at.back().inside(0.9), factor > 1);
        for (std::size_t e = 0; e < ForecastAt::errors; ++e)
            EXPECT_NEAR(wrong.at.front().nineTenths[e] / right.at.front().nineTenths[e], factor, 0.15 * factor) << e;
    }
}

TEST_F(ForecastTest, ForeseesHowFarTheMeanIsOff) {
    const Forecast right = forecastWith(straying);
    const std::vector<NamedModel> means{NamedModel::same("mean", *mean_)};
    const Assessment mean = evaluate(log_, means)->models.front();
    ASSERT_EQ(right.expected.size(), mean.overTime.size());
    for (const std::size_t k : {19u, 99u}) {
        EXPECT_EQ(right.expected[k].time, mean.overTime[k].time);
        EXPECT_NEAR(right.expected[k].position.median / mean.overTime[k].position.median, 1, 0.3);
        EXPECT_NEAR(right.expected[k].heading.p90 / mean.overTime[k].heading.p90, 1, 0.3);
    }
}

TEST_F(ForecastTest, OfTheMeanAloneTheScoreIsItsError) {
    const SampledModel model{NamedModel::same("mean", *mean_), NamedModel::same("mean", *mean_), 0, 1};
    const Forecast alone = forecast(log_, windows_, {&model, 1})->front();
    const std::vector<NamedModel> means{NamedModel::same("mean", *mean_)};
    EXPECT_NEAR(alone.at.back().energy, evaluate(log_, means)->models.front().all.positionFinal.mean, 1e-9);
    EXPECT_TRUE(std::isnan(alone.miss()));
    EXPECT_TRUE(alone.expected.empty());
}

TEST_F(ForecastTest, EndsWhenItIsToldAndNamesAModelThatDoesNotKnowARobot) {
    const NoisyModel noisy(mean_, straying);
    SampledModel model{NamedModel::same("noisy", noisy), NamedModel::same("mean", *mean_), 0, 4};
    EXPECT_FALSE(forecast(log_, windows_, {&model, 1}, [](double) { return false; }));
    model.noisy.forRobot = [](const std::string&) { return nullptr; };
    const auto none = forecast(log_, windows_, {&model, 1});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message(), "noisy: knows no robot r");
}

}  // namespace
}  // namespace mrose
