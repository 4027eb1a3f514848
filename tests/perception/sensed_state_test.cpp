#include "perception/sensed_state.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace mrose {
namespace {

TEST(SensedStates, OthersAreCountedAndTheNearestOfThemKept) {
    SensedState state;
    state.range = 2;
    state.bearing = 3;
    countOther(state, 3, -3);
    EXPECT_EQ(state.others, 1);
    EXPECT_NEAR(state.separation, 2 * std::numbers::pi - 6, 1e-15) << "across the back";
    EXPECT_EQ(state.nearerSeparation, SensedState::apart) << "it is farther";
    countOther(state, 1, 2.5);
    EXPECT_EQ(state.others, 2);
    EXPECT_NEAR(state.separation, 2 * std::numbers::pi - 6, 1e-15);
    EXPECT_EQ(state.nearerSeparation, 0.5);
    countOther(state, 1, 0);
    EXPECT_EQ(state.others, 3);
    EXPECT_EQ(state.nearerSeparation, 0.5);
}

TEST(SensedStates, ClearanceIsOfTheNearestOutlineAndNoLessThanHidden) {
    EXPECT_EQ(clearancePast(SensedState::clear, 0.5), SensedState::clear);
    EXPECT_EQ(clearancePast(0.25, 0.125), 0.125);
    EXPECT_EQ(clearancePast(0.125, 0.25), 0.125);
    EXPECT_EQ(clearancePast(0.125, -1), -SensedState::hidden);
    EXPECT_EQ(clearancePast(-0.125, 0.25), -0.125);
}

TEST(SensedStates, EdgesAreBlurred) {
    const View view{6, 1.2, 0.9};
    SensedState state;
    state.range = 0.9;
    state.bearing = -0.6;
    findEdges(state, view);
    EXPECT_NEAR(state.edge, 0, 1e-6);
    EXPECT_NEAR(state.nearEdge, 0, 1e-6);
    state.range = 0.95;
    state.bearing = 0.55;
    findEdges(state, view);
    EXPECT_NEAR(state.edge, std::tanh(-1), 1e-6);
    EXPECT_NEAR(state.nearEdge, std::tanh(-1), 1e-6);
    state.range = 0;
    findEdges(state, view);
    EXPECT_NEAR(state.nearEdge, 1, 1e-6);
}

}  // namespace
}  // namespace mrose
