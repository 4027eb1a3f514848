#include "assessment/metrics.h"

#include <numbers>

#include <gtest/gtest.h>

#include "assessment/test_models.h"

namespace mrose {
namespace {

Command circling(double) { return {0.1, 0.2}; }

Evaluation evaluated(const Log& log, const MotionModel& model) {
    const NamedModel named = NamedModel::same("model", model);
    auto evaluation = evaluate(log, {&named, 1}, {.withFloor = false});
    EXPECT_TRUE(evaluation) << evaluation.error().message();
    return std::move(*evaluation);
}

TEST(Metrics, ATrueModelHasNoError) {
    const Log log = logOf({obedientTrajectory(0, 60 * second, straightOn)});
    const Summary all = evaluated(log, HeldCommandModel{}).models[0].all;
    EXPECT_EQ(all.windows, 5u);
    EXPECT_NEAR(all.p, 0, 1e-9);
    EXPECT_TRUE(std::isnan(all.hd));  // nothing turns
    EXPECT_NEAR(all.headingFinal.rms, 0, 1e-12);
}

TEST(Metrics, AGainThatIsTwentyPercentTooHighGivesItsClosedForm) {
    const Log log = logOf({obedientTrajectory(0, 60 * second, straightOn)});
    const Assessment model = evaluated(log, HeldCommandModel{100'000'000, 1.2}).models[0];
    // Error 0.02 t, its mean over t = 0.1 ... 10 is 0.02 * 5.05; path 1 m.
    EXPECT_NEAR(model.all.p, 100 * 0.02 * 5.05, 1e-7);
    EXPECT_NEAR(model.all.p95.low, model.all.p95.high, 1e-7);
    EXPECT_NEAR(model.all.positionFinalOverPath.median, 20, 1e-7);
    EXPECT_NEAR(model.all.positionFinal.p90, 0.2, 1e-9);
    EXPECT_NEAR(model.all.along.mean, 0.2, 1e-9);
    EXPECT_NEAR(model.all.left.mean, 0, 1e-9);
    ASSERT_EQ(model.overTime.size(), 100u);
    EXPECT_NEAR(model.overTime[49].time, 5, 1e-12);
    EXPECT_NEAR(model.overTime[49].position.p10, 0.1, 1e-9);
    ASSERT_EQ(model.relative.size(), 4u);
    for (const RelativePoseError& error : model.relative) EXPECT_NEAR(error.position, 0.02 * error.horizon, 1e-9);
    EXPECT_EQ(model.relative[0].pieces, 500u);
    EXPECT_EQ(model.relative[3].pieces, 5u);
}

/// Stands and turns at a wrong rate.
class Turning final : public MotionModel {
public:
    Nanoseconds period() const override { return 50'000'000; }
    Nanoseconds lookBack() const override { return 0; }
    void predict(std::span<const MotionInput>, std::span<MotionStep> steps) const override {
        for (MotionStep& step : steps) step = {{0, 0, 0.05 * 0.5}, {0, 0.5}};
    }
};

TEST(Metrics, HeadingErrorsAreWrappedAndDividedByRotation) {
    // A robot that turns on the spot at 1 rad/s, predicted to turn at 0.5: the error 0.5 t passes half a turn.
    const Log log = logOf({obedientTrajectory(0, 60 * second, [](double) { return Command{0, 1}; })});
    const Assessment model = evaluated(log, Turning{}).models[0];
    double sum = 0;
    for (int k = 1; k <= 100; ++k) {
        const double error = std::fmod(0.05 * k, 2 * std::numbers::pi);
        sum += std::min(error, 2 * std::numbers::pi - error);
    }
    EXPECT_NEAR(model.all.hd, 100 * sum / 100 / 10, 1e-6);
    EXPECT_NEAR(model.all.headingFinal.median, 2 * std::numbers::pi - 5, 1e-8);
    EXPECT_NEAR(model.all.headingSigned.mean, 2 * std::numbers::pi - 5, 1e-8);
    EXPECT_EQ(model.all.positionFinalOverPath.count, 0u);
}

TEST(Metrics, GroupsHoldEveryWindowOncePerKind) {
    Log log = logOf({obedientTrajectory(0, 40 * second, straightOn)});
    log.robots.push_back({"s", {obedientTrajectory(0, 60 * second, circling)}, {}});
    const auto groups = evaluated(log, HeldCommandModel{}).models[0].groups;
    std::map<std::pair<std::string, std::string>, std::size_t> count;
    for (const GroupSummary& group : groups) count[{group.kind, group.name}] = group.summary.windows;
    const decltype(count) expected{
        {{"robot", "r"}, 3}, {{"robot", "s"}, 5}, {{"manoeuvre", "straight"}, 3}, {{"manoeuvre", "turning"}, 5}};
    EXPECT_EQ(count, expected);
}

TEST(Metrics, EachRobotIsPredictedByItsOwnModelOrRefused) {
    Log log = logOf({obedientTrajectory(0, 40 * second, straightOn)});
    log.robots.push_back({"s", {obedientTrajectory(0, 40 * second, straightOn)}, {}});
    const HeldCommandModel right, wrong{100'000'000, 2};
    NamedModel named{"pair", [&](const std::string& robot) { return robot == "r" ? &right : &wrong; }};
    const auto both = evaluate(log, {&named, 1});
    ASSERT_TRUE(both);
    EXPECT_NEAR(both->models[0].groups[0].summary.p, 0, 1e-9);
    EXPECT_NEAR(both->models[0].groups[1].summary.p, 50.5, 1e-6);
    named.forRobot = [&](const std::string& robot) { return robot == "r" ? &right : nullptr; };
    const auto refused = evaluate(log, {&named, 1});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message(), "pair: knows no robot s");
}

TEST(Quantile, InterpolatesLinearly) {
    std::vector<double> values{4, 1, 3, 2};
    EXPECT_DOUBLE_EQ(quantile(values, 0), 1);
    EXPECT_DOUBLE_EQ(quantile(values, 0.5), 2.5);
    EXPECT_DOUBLE_EQ(quantile(values, 0.9), 3.7);
    EXPECT_DOUBLE_EQ(quantile(values, 1), 4);
    EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Bootstrap, CoversTheSpreadOfWindows) {
    // Paths of 1 m, errors of 0 and 0.02 m by turns: P 1 %, its standard error 1 % / sqrt(n).
    std::vector<Window> windows(400);
    std::vector<WindowErrors> errors(400);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < windows.size(); ++i) {
        windows[i].path = 1;
        windows[i].truth.resize(101);
        errors[i].positionMean = i % 2 == 0 ? 0 : 0.02;
        chosen.push_back(i);
    }
    const Summary summary = summarise(windows, errors, chosen, {});
    EXPECT_NEAR(summary.p, 1, 1e-9);
    EXPECT_NEAR(summary.p95.high - summary.p95.low, 2 * 1.96 / 20, 0.02);
}

}  // namespace
}  // namespace mrose
