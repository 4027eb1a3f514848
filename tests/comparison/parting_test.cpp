#include "comparison/parting.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "comparison/divergence_text.h"
#include "support/units.h"

namespace mrose {
namespace {

constexpr double oneDegree = std::numbers::pi / 180, notKnown = std::numeric_limits<double>::quiet_NaN();
constexpr Nanoseconds stepLength = 100 * ms, halfASecond = 500 * ms;

/// A robot that drives 4 cm and turns 1 degree each step, from somewhere and some heading on, and its simulation,
/// which does the same but for steps 20 to 24, in which the real one drives 1 cm less and turns 2 degrees more to the
/// right.
ComparedCourse slowedCourse() {
    ComparedCourse course;
    course.real.measuredPose = {3, -2, 2.5};
    Pose real = course.real.measuredPose, simulated = real;
    course.real.truth.push_back(real);
    for (int k = 0; k < 60; ++k) {
        const bool slowed = k >= 20 && k < 25;
        simulated = simulated * Pose{0.04, 0, oneDegree};
        real = real * Pose{slowed ? 0.03 : 0.04, 0, slowed ? -oneDegree : oneDegree};
        course.simulated.push_back(simulated);
        course.real.truth.push_back(real);
    }
    course.errors = windowErrors(course.real.truth, course.simulated);
    return course;
}

const DivergenceBound closeBound{{0.03, 3 * oneDegree}};

TEST(Parting, IsWhenMostOfTheErrorArose) {
    const ComparedCourse course = slowedCourse();
    const auto divergence = firstDivergence(course, stepLength, closeBound);
    ASSERT_TRUE(divergence);
    const auto parting = partingOf(course, stepLength, *divergence, closeBound.held, halfASecond);
    ASSERT_TRUE(parting);
    EXPECT_EQ(parting->from, 2 * second);
    EXPECT_EQ(parting->to, 2500 * ms);
    EXPECT_NEAR(parting->turn, -10 * oneDegree, 1e-9);
    // What is driven in five steps along a chord of 4 degrees.
    double ahead = 0, left = 0;
    for (int k = 0; k < 5; ++k) {
        ahead += 0.03 * std::cos(-k * oneDegree) - 0.04 * std::cos(k * oneDegree);
        left += 0.03 * std::sin(-k * oneDegree) - 0.04 * std::sin(k * oneDegree);
    }
    EXPECT_NEAR(parting->ahead, ahead, 1e-9);
    EXPECT_NEAR(parting->left, left, 1e-9);

    Diagnosis diagnosis;
    EXPECT_EQ(partingText(diagnosis), "");
    diagnosis.parting = parting;
    diagnosis.parting->explained = 0.934;
    EXPECT_EQ(
        partingText(diagnosis),
        "most of it (93 %) arose from 2.0 to 2.5 s, when the real robot went 5.0 cm less, moved 1.2 cm more to the "
        "right and turned 10.0° more to the right than the simulated one");
}

TEST(Parting, LooksNoFartherThanTheDivergenceAndNotAcrossGaps) {
    ComparedCourse course = slowedCourse();
    const auto divergence = firstDivergence(course, stepLength, closeBound);
    // Something worse that comes later is another matter.
    for (std::size_t k = 50; k < course.real.truth.size(); ++k) course.real.truth[k].x += 1;
    EXPECT_EQ(partingOf(course, stepLength, *divergence, closeBound.held, halfASecond)->from, 2 * second);
    for (std::size_t k = 0; k < 30; ++k) course.real.truth[k] = {notKnown, notKnown, notKnown};
    EXPECT_FALSE(partingOf(course, stepLength, *divergence, 0, halfASecond));
    EXPECT_FALSE(partingOf(slowedCourse(), stepLength, {.time = 300 * ms, .bound = divergence->bound}, 0, halfASecond))
        << "too early";
}

}  // namespace
}  // namespace mrose
