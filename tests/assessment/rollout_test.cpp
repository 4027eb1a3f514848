#include "assessment/rollout.h"

#include <gtest/gtest.h>

#include "assessment/test_models.h"

namespace mrose {
namespace {

Command weaving(double t) { return {0.2 + 0.1 * std::sin(t), 0.5 * std::cos(2 * t)}; }

/// Says how much later than a period's start the newest command was that it could have read.
class SpyModel final : public HeldCommandModel {
public:
    using HeldCommandModel::HeldCommandModel;
    mutable Nanoseconds latest = std::numeric_limits<Nanoseconds>::min();
    mutable std::size_t largestBatch = 0;
    mutable Nanoseconds longestHistory = 0;

    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override {
        largestBatch = std::max(largestBatch, inputs.size());
        HeldCommandModel::predict(inputs, steps);
    }

private:
    MotionStep step(const MotionInput& input) const override {
        const CommandView& h = input.commands;
        latest = std::max(latest, h.issueTime(h.size() - 1) - input.start);
        longestHistory = std::max(longestHistory, input.start - h.issueTime(0));
        return HeldCommandModel::step(input);
    }
};

StampedVelocity atRest(Nanoseconds time) { return {time, {}}; }

TEST(Rollout, FollowsTheExactPathOfAModelThatIsTrue) {
    const Trajectory trajectory = obedientTrajectory(0, 10 * second, weaving);
    const RolloutStart start{&trajectory, 2 * second, trajectory.poses[100].pose, atRest(2 * second), 50};
    const auto poses = rollOut(HeldCommandModel{}, {&start, 1});
    ASSERT_TRUE(poses);
    ASSERT_EQ(poses->at(0).size(), 50u);
    for (std::size_t k = 0; k < 50; ++k) {
        const Pose& real = trajectory.poses[100 + 5 * (k + 1)].pose;
        EXPECT_NEAR(poses->at(0)[k].x, real.x, 1e-12);
        EXPECT_NEAR(poses->at(0)[k].y, real.y, 1e-12);
        EXPECT_NEAR(poses->at(0)[k].heading, real.heading, 1e-12);
    }
}

TEST(Rollout, ReadsNoCommandLaterThanThePeriodsStartAndAtLeastTheLead) {
    const Trajectory trajectory = obedientTrajectory(7, 20 * second, weaving);
    std::vector<RolloutStart> starts;
    for (int i = 0; i < 10; ++i) {
        const Nanoseconds time = 4 * second + i * Nanoseconds{37'123'457};
        starts.push_back({&trajectory, time, {}, atRest(time), 80});
    }
    const SpyModel spy;
    ASSERT_TRUE(rollOut(spy, starts));
    EXPECT_LE(spy.latest, 0);
    EXPECT_GE(spy.longestHistory, 3 * second);
    EXPECT_EQ(spy.largestBatch, 10u);
}

TEST(Rollout, CommandsIssuedLaterChangeNothingBefore) {
    const Trajectory trajectory = obedientTrajectory(0, 12 * second, weaving);
    for (const int known : {0, 17, 60}) {
        Trajectory changed = trajectory;
        const Nanoseconds last = 3 * second + known * (second / 10);
        for (StampedCommand& c : changed.commands)
            if (c.time > last) c.command = {-5, 9};
        const RolloutStart starts[] = {{&trajectory, 3 * second, {}, atRest(3 * second), 80},
                                       {&changed, 3 * second, {}, atRest(3 * second), 80}};
        const auto poses = rollOut(HeldCommandModel{}, starts);
        ASSERT_TRUE(poses);
        for (int k = 0; k <= known; ++k) EXPECT_EQ(poses->at(0)[k], poses->at(1)[k]) << k;
        EXPECT_NE(poses->at(0)[known + 1], poses->at(1)[known + 1]);
    }
}

TEST(Rollout, IsTheSameAloneAndTogetherWithOthersOfOtherLengths) {
    const Trajectory trajectory = obedientTrajectory(0, 20 * second, weaving);
    std::vector<RolloutStart> starts;
    for (const int steps : {5, 60, 0, 31}) {
        const Nanoseconds time = steps * second / 10;
        starts.push_back({&trajectory, time, {}, atRest(time), steps});
    }
    const auto together = rollOut(HeldCommandModel{}, starts);
    ASSERT_TRUE(together);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const auto alone = rollOut(HeldCommandModel{}, {&starts[i], 1});
        ASSERT_TRUE(alone);
        EXPECT_EQ(together->at(i), alone->at(0));
        EXPECT_EQ(together->at(i).size(), static_cast<std::size_t>(starts[i].steps));
    }
}

TEST(Rollout, ShorterPeriodsGiveTheSameOutputSteps) {
    const Trajectory trajectory = obedientTrajectory(0, 10 * second, weaving);
    const RolloutStart start{&trajectory, 2 * second, {}, atRest(2 * second), 40};
    const auto coarse = rollOut(HeldCommandModel{}, {&start, 1});
    const auto fine = rollOut(HeldCommandModel{20'000'000}, {&start, 1});
    ASSERT_TRUE(coarse && fine);
    ASSERT_EQ(fine->at(0).size(), 40u);
    EXPECT_NEAR(fine->at(0)[39].x, coarse->at(0)[39].x, 1e-12);
}

TEST(Rollout, RefusesAPeriodThatDoesNotDivideTheStep) {
    const auto poses = rollOut(HeldCommandModel{30'000'000}, {});
    ASSERT_FALSE(poses);
    EXPECT_EQ(poses.error().message(), "the model's period of 0.03 s does not divide the output's step of 0.1 s");
}

/// v' = v + (command - v) * 0.1 per period: remembers its velocity.
class LaggedModel final : public MotionModel {
public:
    Nanoseconds period() const override { return 100'000'000; }
    Nanoseconds lookBack() const override { return 0; }
    void predict(std::span<const MotionInput> inputs, std::span<MotionStep> steps) const override {
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const double v =
                inputs[i].velocity.v + 0.1 * (inputs[i].commands.at(inputs[i].start).v - inputs[i].velocity.v);
            steps[i] = {{0.1 * v, 0, 0}, {v, 0}};
        }
    }
};

TEST(Rollout, UnknownStartVelocityIsWhatTheModelReachesOverTheLead) {
    Trajectory trajectory = obedientTrajectory(0, 5 * second, [](double) { return Command{1, 0}; });
    const RolloutStart standing{&trajectory, 0, {}, {}, 1};
    const auto fromRest = rollOut(LaggedModel{}, {&standing, 1});
    ASSERT_TRUE(fromRest);
    EXPECT_NEAR(fromRest->at(0)[0].x, 0.1 * 0.1, 1e-15);

    trajectory.steady = true;
    const auto underWay = rollOut(LaggedModel{}, {&standing, 1});
    ASSERT_TRUE(underWay);
    EXPECT_NEAR(underWay->at(0)[0].x, 0.1 * (1 - std::pow(0.9, 31)), 1e-14);
}

TEST(Rollout, EarlierVelocityIsCarriedOnByTheModel) {
    const Trajectory trajectory = obedientTrajectory(0, 10 * second, [](double t) {
        return Command{t < 4.75 ? 1. : 2., 0};
    });
    constexpr Nanoseconds ms = 1'000'000;
    std::vector<RolloutStart> starts;
    for (const Nanoseconds age : {0 * ms, 49 * ms, 51 * ms, 100 * ms, 300 * ms})
        starts.push_back({&trajectory, 5 * second, {}, StampedVelocity{5 * second - age, {0.5, 0}}, 1});
    fillVelocities(LaggedModel{}, starts);
    const double toOne = 0.5 + 0.1 * (1 - 0.5);  // in the period that begins before the change
    const double expected[] = {0.5, 0.5, 0.5 + 0.1 * (2 - 0.5), 0.5 + 0.1 * (2 - 0.5), 2 - 0.9 * 0.9 * (2 - toOne)};
    for (std::size_t i = 0; i < starts.size(); ++i) {
        EXPECT_EQ(starts[i].velocity->time, 5 * second);
        EXPECT_NEAR(starts[i].velocity->velocity.v, expected[i], 1e-15) << i;
    }
}

}  // namespace
}  // namespace mrose
