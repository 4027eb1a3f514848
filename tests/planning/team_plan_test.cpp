#include "planning/team_plan.h"

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
    EXPECT_NEAR(plan.rests, std::numbers::pi / 2 + 4 / 0.4 + 1, 1e-9);
    EXPECT_EQ(plan.unclear, 0u);
    EXPECT_EQ(plan.stuck, 0u);
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
            ASSERT_EQ(plan.unclear, 0u);
            std::vector<TimedPath> paths;
            for (std::size_t i = 0; i < 2; ++i) {
                DriveTimes drive = teamsDrive;
                drive.heading = team[i].start.heading;
                paths.push_back(plan.plans[i].timed(drive));
            }
            EXPECT_FALSE(firstConflict(paths[1 - first], paths[first], 0.6));
        }
}

TEST(TeamPlan, WhoHasNoWayIsCounted) {
    std::vector<ConvexPiece> pieces = room(6, 4);
    pieces.push_back(boxPiece({3, 2, 0}, 0.4, 4));
    const std::vector<TeamMember> team{{{1, 1, 0}, {5, 1, 0}}, {{1, 3, 0}, {2, 3, 0}}};
    const TeamPlan plan = teamPlan(team, DiscSpace(pieces, 0.25), {}, teamsDrive, 0.6);
    EXPECT_EQ(plan.stuck, 1u);
    EXPECT_NEAR(plan.rests, 1 / 0.4, 1e-9);
}

}  // namespace
}  // namespace mrose
