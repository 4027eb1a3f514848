#include "planning/team_plan.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "planning/planning_worlds.h"

namespace mrose {
namespace {

constexpr DriveTimes teamsDrive{.heading = 0, .speed = 0.4, .rotation = 1};

TEST(TeamPlan, OneAloneTurnsDrivesAndTurns) {
    const DiscSpace space(room(6, 4), 0.25);
    const std::vector<TeamMember> team{{{1, 1, std::numbers::pi / 2}, {5, 1, -1}}};
    const TeamPlan plan = teamPlan(team, space, {}, teamsDrive, 0.6);
    EXPECT_NEAR(plan.estimate.rests, std::numbers::pi / 2 + 4 / 0.4 + 1, 1e-9);
    EXPECT_NEAR(plan.estimate.length, 4, 1e-9);
    EXPECT_NEAR(plan.estimate.turns, std::numbers::pi / 2 + 1, 1e-9);
    EXPECT_EQ(plan.estimate.nearest, TeamEstimate::apart);
    EXPECT_EQ(plan.estimate.unclear, 0u);
    EXPECT_EQ(plan.estimate.stuck, 0u);
}

/// Who goes first drives as if alone, and nobody's plan conflicts with that of one before it.
TEST(TeamPlan, WhoGoesFirstDoesNotGiveWay) {
    const DiscSpace space(room(6, 4), 0.25);
    const std::vector<TeamMember> team{{{1, 2, 0}, {5, 2, 0}}, {{3, 0.5, 1.57}, {3, 3.5, 1.57}}};
    for (const bool lowest : {true, false})
        for (const Repair repair : {Repair::wait, Repair::imaginedObstacle}) {
            const TeamPlan plan = teamPlan(team, space, {Planner::visibilityGraph, repair, lowest}, teamsDrive, 0.6);
            const std::size_t first = lowest ? 0 : 1;
            EXPECT_EQ(plan.plans[first].points.size(), 2u);
            EXPECT_EQ(plan.plans[first].hold.duration, 0);
            EXPECT_TRUE(plan.plans[1 - first].hold.duration > 0 || plan.plans[1 - first].points.size() > 2);
            ASSERT_EQ(plan.estimate.unclear, 0u);
            std::vector<TimedPath> paths;
            for (std::size_t i = 0; i < 2; ++i) {
                DriveTimes drive = teamsDrive;
                drive.heading = team[i].start.heading;
                paths.push_back(plan.plans[i].timed(drive));
            }
            EXPECT_FALSE(firstConflict(paths[1 - first], paths[first], 0.6));
        }
}

/// One passes half a metre behind where the other one stands by then.
TEST(TeamPlan, EstimatesAreThoseOfAllMembers) {
    const DiscSpace space(room(8, 6), 0.25);
    const std::vector<TeamMember> team{{{1, 1, 0}, {3, 1, 0}}, {{3.5, 5, -std::numbers::pi / 2}, {3.5, 2, 0}}};
    DriveTimes late = teamsDrive;
    late.begin = 0.3;
    const TeamEstimate estimate = teamPlan(team, space, {}, late, 0.6).estimate;
    EXPECT_NEAR(estimate.rests, 0.3 + 3 / 0.4 + std::numbers::pi / 2, 1e-9);
    EXPECT_NEAR(estimate.resting, estimate.rests + 0.3 + 2 / 0.4, 1e-9);
    EXPECT_NEAR(estimate.length, 5, 1e-9);
    EXPECT_NEAR(estimate.nearest, std::hypot(0.5, 1), 1e-9);
    EXPECT_EQ(estimate.stops, 0);
}

TEST(TeamPlan, NamesOfMethodsAreReadAsTheyAreWritten) {
    for (std::size_t planner = 0; planner < plannerNames.size(); ++planner)
        for (std::size_t repair = 0; repair < repairNames.size(); ++repair)
            for (const bool lowest : {true, false}) {
                const TeamMethod method{static_cast<Planner>(planner), static_cast<Repair>(repair), lowest};
                EXPECT_EQ(teamMethod(nameOf(method)), method);
            }
    EXPECT_EQ(nameOf({}), "visibility_graph+wait+lowest");
    for (const char* const none : {"", "+", "++", "visibility_graph", "visibility_graph+wait",
                                   "visibility_graph+wait+first", "astar+wait+lowest", "voronoi+wait+lowest+lowest"})
        EXPECT_FALSE(teamMethod(none)) << none;
}

TEST(TeamPlan, WhoHasNoWayIsCounted) {
    std::vector<ConvexPiece> pieces = room(6, 4);
    pieces.push_back(boxPiece({3, 2, 0}, 0.4, 4));
    const std::vector<TeamMember> team{{{1, 1, 0}, {5, 1, 0}}, {{1, 3, 0}, {2, 3, 0}}};
    const TeamPlan plan = teamPlan(team, DiscSpace(pieces, 0.25), {}, teamsDrive, 0.6);
    EXPECT_EQ(plan.estimate.stuck, 1u);
    EXPECT_NEAR(plan.estimate.rests, 1 / 0.4, 1e-9);
}

}  // namespace
}  // namespace mrose
