#include "diagnosis/divergence.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "assessment/truth_jumps.h"
#include "support/units.h"

namespace mrose {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Nanoseconds apart = 100 * ms;

/// A robot that stands at the origin, and its simulation, so far off after each step.
ComparedRollout rolloutOff(const std::vector<double>& position, const std::vector<double>& heading = {}) {
    ComparedRollout rollout;
    rollout.real.truth.resize(position.size() + 1);
    for (std::size_t k = 0; k < position.size(); ++k) {
        if (std::isnan(position[k])) rollout.real.truth[k + 1] = {nan, nan, nan};
        rollout.simulated.push_back({0.6 * position[k], -0.8 * position[k], k < heading.size() ? heading[k] : 0});
    }
    rollout.errors = windowErrors(rollout.real.truth, rollout.simulated);
    return rollout;
}

std::optional<Divergence> divergenceOf(const std::vector<double>& position, const std::vector<double>& heading = {},
                                       DivergenceBound bound = {}) {
    bound.constant = {0.1, 10 * degree};
    return firstDivergence(rolloutOff(position, heading), apart, bound);
}

TEST(DivergenceRule, IsTheSameForwardsAndBackwards) {
    using State = DivergenceRule::State;
    const DivergenceBound::At bound{0.1, 10 * degree};
    // Beyond from 0.2 s on, by the heading at 0.5 s; the truth is not known at 0.3 and 0.4 s.
    DivergenceRule forwards(300 * ms);
    EXPECT_EQ(forwards.add(100 * ms, {0.1, 10 * degree}, bound), State::within) << "the bound itself is within";
    EXPECT_EQ(forwards.add(200 * ms, {0.11, 0}, bound), State::beyond);
    EXPECT_EQ(forwards.add(500 * ms, {0, 11 * degree}, bound), State::left);
    EXPECT_EQ(forwards.since(), 200 * ms);
    DivergenceRule backwards(300 * ms);
    EXPECT_EQ(backwards.add(500 * ms, {0, 11 * degree}, bound), State::beyond);
    EXPECT_EQ(backwards.add(200 * ms, {0.11, 0}, bound), State::left);
    EXPECT_EQ(backwards.since(), 500 * ms);
    EXPECT_EQ(backwards.add(100 * ms, {0.1, 10 * degree}, bound), State::within);
}

TEST(FirstDivergence, IsTheFirstInstantFromWhichTheBoundIsExceededForSoLong) {
    const auto found = divergenceOf({0, 0.05, 0.2, 0.09, 0.11, 0.12, 0.13, 0.3, 0.4});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->time, 500 * ms) << "0.3 s before it was beyond for an instant only";
    EXPECT_EQ(found->within, 400 * ms);
    EXPECT_NEAR(found->position, 0.11, 1e-12);
    EXPECT_TRUE(found->byPosition);
    EXPECT_FALSE(found->byHeading);
    EXPECT_EQ(found->bound, (DivergenceBound::At{0.1, 10 * degree}));
}

TEST(FirstDivergence, ThatIsNotHeldDoesNotCount) {
    // Beyond at 0.2, 0.3 and 0.4 s: 0.2 s.
    EXPECT_FALSE(divergenceOf({0, 0.2, 0.2, 0.2, 0, 0}));
    EXPECT_EQ(divergenceOf({0, 0.2, 0.2, 0.2, 0.2, 0})->time, 200 * ms);
    EXPECT_FALSE(divergenceOf({0, 0, 0.2, 0.2, 0.2})) << "at the end too";
    DivergenceBound atOnce;
    atOnce.held = 0;
    EXPECT_EQ(divergenceOf({0, 0.2, 0}, {}, atOnce)->time, 200 * ms);
    EXPECT_FALSE(divergenceOf({0, 0.1, 0.1, 0.1, 0.1, 0.1})) << "on the bound is not beyond it";
}

TEST(FirstDivergence, MayBeThereFromTheFirstInstantOnOrNever) {
    const auto found = divergenceOf({0.2, 0.2, 0.2, 0.2, 0.2});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->time, 100 * ms);
    EXPECT_EQ(found->within, 0);
    EXPECT_FALSE(divergenceOf(std::vector<double>(100, 0.05)));
    EXPECT_FALSE(divergenceOf({})) << "of a robot that was not in the world";
    EXPECT_FALSE(divergenceOf(std::vector<double>(20, nan)));
}

TEST(FirstDivergence, GapsInTheTruthNeitherProveNorDisproveIt) {
    // Beyond before and behind the gap.
    const auto across = divergenceOf({0, 0.2, nan, nan, nan, 0.2});
    ASSERT_TRUE(across);
    EXPECT_EQ(across->time, 200 * ms);
    EXPECT_FALSE(divergenceOf({0, 0.2, nan, nan, nan, 0.05, 0.05, 0.05}));
    // It left within the gap: it is not known when.
    const auto within = divergenceOf({0, 0.05, nan, nan, nan, 0.2, 0.2, 0.2, 0.2});
    ASSERT_TRUE(within);
    EXPECT_EQ(within->within, 200 * ms);
    EXPECT_EQ(within->time, 600 * ms);
}

TEST(FirstDivergence, HeadingCountsAsWellAndIsWrapped) {
    const std::vector<double> still(8, 0.0);
    const auto found = divergenceOf(still, {0, 0, 2 * std::numbers::pi, 11 * degree, -12 * degree, 0.3, 0.3, 0.3});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->time, 400 * ms) << "a whole turn is no error";
    EXPECT_NEAR(found->heading, 11 * degree, 1e-12);
    EXPECT_TRUE(found->byHeading);
    EXPECT_FALSE(found->byPosition);
    EXPECT_FALSE(divergenceOf(still, std::vector<double>(8, 2 * std::numbers::pi - 9 * degree)));
    // First the one, then the other is beyond: either is enough at each instant.
    EXPECT_EQ(divergenceOf({0, 0.2, 0.2, 0, 0, 0}, {0, 0, 0, 0.3, 0.3, 0})->time, 200 * ms);
}

TEST(FirstDivergence, BoundMayDependOnTheTime) {
    DivergenceBound bound;
    bound.bySteps = {{0.01, 1}, {0.02, 1}, {0.05, 1}, {0.3, 1}};
    const auto found = firstDivergence(rolloutOff({0, 0.01, 0.1, 0.2, 0.31, 0.32, 0.33, 0.34}), apart, bound);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->time, 500 * ms) << "the last bound goes on";
    EXPECT_EQ(found->bound.position, 0.3);
    EXPECT_EQ(firstDivergence(rolloutOff({0, 0.03, 0.1, 0.4, 0.5, 0.6}), apart, bound)->time, 200 * ms);
}

/// Straight on at 0.5 m/s, then on the spot at 1 rad/s.
ComparedRollout driveThenTurn(int driving, int turning) {
    ComparedRollout rollout;
    for (int k = 0; k <= driving + turning; ++k) {
        rollout.real.truth.push_back({0.05 * std::min(k, driving), 0, 0.1 * std::max(0, k - driving)});
        if (k > 0) rollout.simulated.push_back(rollout.real.truth.back());
    }
    return rollout;
}

TEST(HeldOutBound, IsThreeTimesTheTypicalErrorAtThatPathAndRotation) {
    const MotionNetwork::HeldOut heldOut{100, 10, 2, 3};
    const DivergenceBound bound = heldOutBound(heldOut, driveThenTurn(100, 100), apart);
    ASSERT_EQ(bound.bySteps.size(), 200u);
    // P is the mean over time of an error that grows in proportion: at the end it is twice that.
    const DivergenceBound::At driven = bound.at(99), turned = bound.at(199);
    EXPECT_NEAR(driven.position, 3 * 2 * 0.02 * 5, 1e-9) << "2 % of 5 m";
    EXPECT_NEAR(turned.position, driven.position, 1e-9) << "the path does not grow any more";
    EXPECT_NEAR(turned.heading, 3 * 2 * 0.03 * 10, 1e-9) << "3 % of 10 rad";
    // A heading that is off by h puts it h / 2 of its path off: 2 * 0.02 of it typically.
    EXPECT_NEAR(driven.heading, 3 * 2 * 0.02 * 2, 1e-9);
    EXPECT_NEAR(bound.at(49).position, driven.position / 2, 1e-9);
    EXPECT_NEAR(bound.at(0).position, 0.02, 1e-12) << "no less than what the start is measured to";
    EXPECT_EQ(bound.at(1000), turned);
}

TEST(HeldOutBound, CountsThePathAcrossGaps) {
    const MotionNetwork::HeldOut heldOut{100, 10, 2, 3};
    ComparedRollout rollout = driveThenTurn(100, 0);
    const double whole = heldOutBound(heldOut, rollout, apart).at(99).position;
    for (std::size_t k = 33; k < 58; ++k) rollout.real.truth[k] = {nan, nan, nan};
    EXPECT_NEAR(heldOutBound(heldOut, rollout, apart).at(99).position, whole, 1e-9);
    rollout.real.truth[0] = {nan, nan, nan};
    const DivergenceBound bound = heldOutBound(heldOut, rollout, apart);
    EXPECT_NEAR(bound.at(99).position, whole * 0.99, 1e-9) << "of the first step nothing is known";
}

TEST(HeldOutBound, DoesNotCountWhatTheTruthJumps) {
    const MotionNetwork::HeldOut heldOut{100, 10, 2, 3};
    ComparedRollout rollout = driveThenTurn(100, 100);
    const DivergenceBound whole = heldOutBound(heldOut, rollout, apart);
    for (std::size_t k = 43; k <= 200; ++k) {
        rollout.real.truth[k].x += 3;
        rollout.real.truth[k].heading += 2;
    }
    EXPECT_GT(heldOutBound(heldOut, rollout, apart).at(199).position, 1.5 * whole.at(199).position);
    rollout.jumps = {43};
    const DivergenceBound bound = heldOutBound(heldOut, rollout, apart);
    EXPECT_EQ(bound.at(41), whole.at(41));
    EXPECT_NEAR(bound.at(99).position, whole.at(99).position * 0.99, 1e-9) << "of that step nothing is known";
    EXPECT_NEAR(bound.at(199).heading, whole.at(199).heading, 1e-9);
}

/// Told 1 m/s and 1 rad/s, and seen so, or seen in stairs of 0.4 s.
Trajectory seen(bool stairs) {
    Trajectory trajectory;
    for (int i = 0; i < 100; ++i) {
        const double t = 0.05 * (stairs ? i / 8 * 8 : i);
        trajectory.commands.push_back({i * 50 * ms, {1, 1}});
        trajectory.poses.push_back({i * 50 * ms, {t, 0, t}});
    }
    return trajectory;
}

TEST(TruthJumps, AreWhatNoRobotMovesThatWasToldSo) {
    for (const bool stairs : {false, true}) {
        Trajectory trajectory = seen(stairs);
        const auto jumps = [&](Nanoseconds from = 0, Nanoseconds to = 5 * second) {
            return truthJumps(trajectory, from, to);
        };
        EXPECT_TRUE(jumps().empty()) << stairs;
        for (std::size_t i = 48; i < 100; ++i) trajectory.poses[i].pose.y += 1.2;
        for (std::size_t i = 72; i < 100; ++i) trajectory.poses[i].pose.heading -= 1.6;
        ASSERT_EQ(jumps().size(), 2u) << stairs;
        const TruthJump aside = jumps()[0], turn = jumps()[1];
        EXPECT_EQ(aside.before, 47 * 50 * ms);
        EXPECT_EQ(aside.after, 48 * 50 * ms);
        EXPECT_NEAR(aside.distance, std::hypot(1.2, stairs ? 0.4 : 0.05), 1e-9);
        EXPECT_EQ(turn.after, 72 * 50 * ms);
        EXPECT_NEAR(turn.turn, stairs ? 1.2 : 1.55, 1e-9);
        EXPECT_EQ(jumps(48 * 50 * ms).size(), 1u) << "one that has been";
        EXPECT_EQ(jumps(0, 72 * 50 * ms - 1).size(), 1u) << "one to come";
        // Told to be as fast as that, it may have been.
        for (StampedCommand& command : trajectory.commands) command.command = {20, 40};
        EXPECT_TRUE(jumps().empty());
        trajectory.commands.clear();
        EXPECT_TRUE(jumps().empty());
    }
}

}  // namespace
}  // namespace mrose
