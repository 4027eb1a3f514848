#include "diagnosis/error_onset.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "diagnosis/divergence_text.h"
#include "support/units.h"

namespace mrose {
namespace {

constexpr double oneDegree = std::numbers::pi / 180, notKnown = std::numeric_limits<double>::quiet_NaN();
constexpr Nanoseconds stepLength = 100 * ms, halfASecond = 500 * ms;

/// A robot that drives 4 cm and turns 1 degree each step, from somewhere and some heading on, and its simulation,
/// which does the same but for steps 20 to 24, in which the real one drives 1 cm less and turns 2 degrees more to the
/// right.
ComparedRollout slowedRollout() {
    ComparedRollout rollout;
    rollout.real.measuredPose = {3, -2, 2.5};
    Pose real = rollout.real.measuredPose, simulated = real;
    rollout.real.truth.push_back(real);
    for (int k = 0; k < 60; ++k) {
        const bool slowed = k >= 20 && k < 25;
        simulated = simulated * Pose{0.04, 0, oneDegree};
        real = real * Pose{slowed ? 0.03 : 0.04, 0, slowed ? -oneDegree : oneDegree};
        rollout.simulated.push_back(simulated);
        rollout.real.truth.push_back(real);
    }
    rollout.errors = windowErrors(rollout.real.truth, rollout.simulated);
    return rollout;
}

const DivergenceBound closeBound{{0.03, 3 * oneDegree}};

TEST(ErrorOnset, IsWhenMostOfTheErrorArose) {
    const ComparedRollout rollout = slowedRollout();
    const auto divergence = firstDivergence(rollout, stepLength, closeBound);
    ASSERT_TRUE(divergence);
    const auto onset = errorOnsetOf(rollout, stepLength, *divergence, closeBound.held, halfASecond);
    ASSERT_TRUE(onset);
    EXPECT_EQ(onset->from, 2 * second);
    EXPECT_EQ(onset->to, 2500 * ms);
    EXPECT_NEAR(onset->turn, -10 * oneDegree, 1e-9);
    // What is driven in five steps along a chord of 4 degrees.
    double ahead = 0, left = 0;
    for (int k = 0; k < 5; ++k) {
        ahead += 0.03 * std::cos(-k * oneDegree) - 0.04 * std::cos(k * oneDegree);
        left += 0.03 * std::sin(-k * oneDegree) - 0.04 * std::sin(k * oneDegree);
    }
    EXPECT_NEAR(onset->ahead, ahead, 1e-9);
    EXPECT_NEAR(onset->left, left, 1e-9);

    Diagnosis diagnosis;
    EXPECT_EQ(onsetText(diagnosis), "");
    diagnosis.onset = onset;
    diagnosis.onset->explained = 0.934;
    EXPECT_EQ(onsetText(diagnosis),
              "93 % of the error at leaving arose from 2.0 to 2.5 s, when the real robot went 5.0 cm less, moved 1.2 "
              "cm more to the "
              "right and turned 10.0° more to the right than the simulated one");
}

TEST(ErrorOnset, LooksNoFartherThanTheDivergenceAndNotAcrossGaps) {
    ComparedRollout rollout = slowedRollout();
    const auto divergence = firstDivergence(rollout, stepLength, closeBound);
    // Something worse that comes later is another matter.
    for (std::size_t k = 50; k < rollout.real.truth.size(); ++k) rollout.real.truth[k].x += 1;
    EXPECT_EQ(errorOnsetOf(rollout, stepLength, *divergence, closeBound.held, halfASecond)->from, 2 * second);
    for (std::size_t k = 0; k < 30; ++k) rollout.real.truth[k] = {notKnown, notKnown, notKnown};
    EXPECT_FALSE(errorOnsetOf(rollout, stepLength, *divergence, 0, halfASecond));
    EXPECT_FALSE(
        errorOnsetOf(slowedRollout(), stepLength, {.time = 300 * ms, .bound = divergence->bound}, 0, halfASecond))
        << "too early";
}

}  // namespace
}  // namespace mrose
