#include "planning/repairs.h"

#include <cmath>

#include <gtest/gtest.h>

#include "planning/planning_worlds.h"

namespace mrose {
namespace {

const PathFinder openRoom(Planner::visibilityGraph, DiscSpace(room(6, 4), 0.25));

PlanRequest crossing(Repair repair, std::span<const TimedPath> others) {
    return {openRoom, repair, {1, 2}, {5, 2}, {.heading = 0, .speed = 0.4}, others, 0.6};
}

/// Comes from above and goes to below just when the other one is in the middle.
std::vector<TimedPath> crosser() { return {timedPath({{3, 3.6}, {3, 0.4}}, {.heading = -M_PI / 2, .speed = 0.4})}; }

TEST(Repairs, NothingIsRepairedWhereNothingConflicts) {
    for (std::size_t repair = 0; repair < repairNames.size(); ++repair) {
        const Plan plan = repairedPlan(crossing(static_cast<Repair>(repair), {}));
        EXPECT_TRUE(plan.found() && plan.clear);
        EXPECT_EQ(plan.points.size(), 2u);
        EXPECT_EQ(plan.hold.duration, 0);
    }
}

TEST(Repairs, ClearPlansDoNotConflict) {
    int cleared = 0, conflicting = 0;
    for (std::int64_t trial = 0; trial < 60; ++trial) {
        const DiscSpace space = drawnRoom(51, trial);
        const PathFinder finder(Planner::visibilityGraph, space);
        std::vector<TimedPath> others;
        for (std::uint32_t i = 0; i < 3; ++i)
            others.push_back(timedPath({drawnPlace(space, 52, trial, 100 * i), drawnPlace(space, 53, trial, 100 * i)},
                                       {.heading = 0, .speed = 0.4}));
        const Point start = drawnPlace(space, 54, trial, 0), goal = drawnPlace(space, 55, trial, 0);
        for (std::size_t repair = 0; repair < repairNames.size(); ++repair) {
            const PlanRequest request{
                finder, static_cast<Repair>(repair), start, goal, {.heading = 0, .speed = 0.4}, others, 0.55};
            const Plan plan = repairedPlan(request);
            if (!plan.found()) continue;
            EXPECT_EQ(plan.points.front(), start);
            EXPECT_EQ(plan.points.back(), goal);
            for (std::size_t i = 1; i < plan.points.size(); ++i)
                EXPECT_GE(space.distance(plan.points[i - 1], plan.points[i], 1), 0.25 - 0.005);
            const auto conflict = firstConflict(plan.timed(request.drive), others, request.separation);
            EXPECT_EQ(plan.clear, !conflict.has_value()) << trial << ' ' << repairNames[repair];
            if (repair == 0 && conflict) ++conflicting;
            if (repair > 0 && plan.clear) ++cleared;
        }
    }
    EXPECT_GE(conflicting, 15);
    EXPECT_GE(cleared, 100);
}

/// Who waits leaves as late as the other one has passed: no shorter stop of the same kind does.
TEST(Repairs, WaitingStopsBeforeTheOtherOnesWayForTheLeastTime) {
    const auto others = crosser();
    const PlanRequest request = crossing(Repair::wait, others);
    const Plan plan = repairedPlan(request);
    ASSERT_TRUE(plan.clear);
    EXPECT_EQ(plan.points.size(), 2u);
    EXPECT_GT(plan.hold.at, 0.3);
    EXPECT_LT(plan.hold.at, 2 - 0.5);
    EXPECT_GT(plan.hold.duration, 0.3);
    Plan shorter = plan;
    shorter.hold.duration -= 0.5;
    EXPECT_TRUE(firstConflict(shorter.timed(request.drive), others, 0.6));
}

TEST(Repairs, ATemporaryTargetIsWhereNobodyPasses) {
    // Head on: waiting on the way does not help.
    const std::vector<TimedPath> others{timedPath({{5, 2}, {1, 2}}, {.heading = M_PI, .speed = 0.4})};
    EXPECT_FALSE(repairedPlan(crossing(Repair::wait, others)).clear);
    const PlanRequest request = crossing(Repair::temporaryTarget, others);
    const Plan plan = repairedPlan(request);
    ASSERT_TRUE(plan.clear);
    EXPECT_GE(plan.points.size(), 3u);
    double aside = 0;
    for (const Point& point : plan.points) aside = std::max(aside, std::abs(point.y - 2));
    EXPECT_GE(aside, 0.3);
}

TEST(Repairs, AnImaginedObstacleIsDrivenRound) {
    const auto others = crosser();
    const Plan plan = repairedPlan(crossing(Repair::imaginedObstacle, others));
    ASSERT_TRUE(plan.clear);
    EXPECT_EQ(plan.hold.duration, 0);
    double off = 0;
    for (const Point& point : plan.points) off = std::max(off, std::abs(point.y - 2));
    EXPECT_GT(off, 0.2);
}

TEST(Repairs, ReplanningGoesRoundWhereTheOtherOneIs) {
    const std::vector<TimedPath> others{timedPath({{3, 2.1}, {3, 2.2}, {3, 2.0}}, {.heading = 0, .speed = 0.02})};
    const Plan plan = repairedPlan(crossing(Repair::replan, others));
    double nearest = 9;
    for (std::size_t i = 1; i < plan.points.size(); ++i)
        nearest = std::min(nearest, distanceToSegment({3, 2.1}, plan.points[i - 1], plan.points[i]));
    EXPECT_NEAR(nearest, 0.6, 1e-3);
}

}  // namespace
}  // namespace mrose
