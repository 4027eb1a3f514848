#include "behaviour/navigate.h"

#include <gtest/gtest.h>

#include "behaviour/small_field.h"

namespace mrose {
namespace {

/// Knows where it is within a centimetre, and sees all round.
RobotType navigator() {
    Perception perception;
    perception.self.noise = {0.01, 0.01, 0.01};
    return guideRobot(perception);
}

const Environment& navigatorsField() {
    static const Environment field = walledField(9, 5);
    return field;
}

Navigate::Options navigating(const Pose& target, Planner planner, Repair repair) {
    return {.target = target,
            .method = {planner, repair},
            .radius = 0.31,
            .objectRadius = 0.22,
            .walls = floorPlanOf(navigatorsField())};
}

bool atRest(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    const auto entries = explained(scenario.controller(robot), scenario.memoryOf(state, robot));
    return entries.front().text == "resting";
}

struct Team {
    std::vector<std::pair<Pose, Pose>> ways;
    std::vector<Pose> boxes;
};

Scenario teamOf(const Team& team, Planner planner, Repair repair) {
    SmallWorld world(navigatorsField());
    for (std::size_t i = 0; i < team.ways.size(); ++i)
        world.robot(navigator(), team.ways[i].first,
                    std::make_shared<const Navigate>(navigating(team.ways[i].second, planner, repair)), noisyDrive(),
                    static_cast<std::int64_t>(i));
    for (const Pose& box : team.boxes) world.object(boxType(0.3, 80), box);
    return world.scenario();
}

/// Steps until all rest, 60 s at most; how long two bodies touched, in ticks.
int touches(const Scenario& scenario, WorldState& state) {
    StepBuffers buffers;
    int touching = 0;
    for (int tick = 0; tick < 60 * ticksPerSecond; ++tick) {
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        touching += trace.contacts.empty() ? 0 : 1;
        bool all = true;
        for (std::size_t i = 0; i < state.robots.size(); ++i) all = all && atRest(scenario, state, i);
        if (all) break;
    }
    return touching;
}

bool arrived(const Scenario& scenario, const WorldState& state, const Team& team) {
    for (std::size_t i = 0; i < team.ways.size(); ++i) {
        const Pose& pose = state.robots[i].pose;
        const Pose& target = team.ways[i].second;
        if (!atRest(scenario, state, i) || distance(position(pose), position(target)) > 0.1 ||
            std::abs(wrapAngle(pose.heading - target.heading)) > 0.2)
            return false;
    }
    return true;
}

TEST(Navigate, ComesToRestAtItsTargetAmongBoxesByEachPlanner) {
    const Team team{{{{1, 1, 2}, {8, 4, 1}}}, {{3, 2, 0.3}, {5, 2.7, 1}, {6.5, 3.4, 0}, {4, 1.2, 0}}};
    for (std::size_t planner = 0; planner < plannerNames.size(); ++planner) {
        const Scenario scenario = teamOf(team, static_cast<Planner>(planner), Repair::none);
        WorldState state = scenario.initialState();
        EXPECT_EQ(touches(scenario, state), 0) << plannerNames[planner];
        EXPECT_TRUE(arrived(scenario, state, team)) << plannerNames[planner];
    }
}

TEST(Navigate, WhoseWaysCrossArriveAndThoseWhoForeseeTheConflictDoNotTouch) {
    const Team team{{{{2.7, 2.5, 0}, {8, 2.5, 0}}, {{4.5, 0.7, 1.57}, {4.5, 4.3, 1.57}}}, {}};
    for (std::size_t repair = 1; repair < repairNames.size(); ++repair) {
        const Scenario scenario = teamOf(team, Planner::visibilityGraph, static_cast<Repair>(repair));
        WorldState state = scenario.initialState();
        const int touching = touches(scenario, state);
        // Who replans goes round where the other one is, not where it will be.
        EXPECT_TRUE(touching == 0 || static_cast<Repair>(repair) == Repair::replan) << repairNames[repair];
        EXPECT_TRUE(arrived(scenario, state, team)) << repairNames[repair];
    }
}

TEST(Navigate, WhoMeetsHeadOnGetsPast) {
    const Team team{{{{1.5, 2.5, 0}, {7.5, 2.5, 0}}, {{7.5, 2.5, 3.1}, {1.5, 2.5, 3.1}}}, {}};
    for (const Repair repair : {Repair::temporaryTarget, Repair::imaginedObstacle}) {
        const Scenario scenario = teamOf(team, Planner::visibilityGraph, repair);
        WorldState state = scenario.initialState();
        EXPECT_LT(touches(scenario, state), ticksPerSecond / 2);
        EXPECT_TRUE(arrived(scenario, state, team));
    }
}

/// The one of the lower index goes straight on; the other one makes way.
TEST(Navigate, TheHigherIndexGivesWay) {
    const Team both{{{{2.7, 2.5, 0}, {8, 2.5, 0}}, {{4.5, 0.7, 1.57}, {4.5, 4.3, 1.57}}}, {}};
    const auto restsAfter = [](const Scenario& scenario, std::size_t robot) {
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        int tick = 0;
        while (tick < 60 * ticksPerSecond && !atRest(scenario, state, robot)) {
            step(scenario, state, buffers);
            ++tick;
        }
        return tick;
    };
    const Scenario together = teamOf(both, Planner::visibilityGraph, Repair::wait);
    const Scenario first = teamOf({{both.ways[0]}, {}}, Planner::visibilityGraph, Repair::wait);
    const Scenario second = teamOf({{both.ways[1]}, {}}, Planner::visibilityGraph, Repair::wait);
    EXPECT_LT(restsAfter(together, 0), restsAfter(first, 0) + ticksPerSecond);
    EXPECT_GT(restsAfter(together, 1), restsAfter(second, 0) + ticksPerSecond);
}

TEST(Navigate, ABoxThatItSawOnceIsRemembered) {
    RobotType blinkered = navigator();
    blinkered.perception.objects.range = 1.2;
    SmallWorld world(navigatorsField());
    world.robot(blinkered, {1, 2.5, 0},
                std::make_shared<const Navigate>(navigating({8, 2.5, 0}, Planner::visibilityGraph, Repair::none)),
                lateDrive());
    world.object(boxType(0.3, 80), {4, 2.5, 0});
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    EXPECT_EQ(touches(scenario, state), 0);
    const auto entries = explained(scenario.controller(0), scenario.memoryOf(state, 0));
    double x = 0;
    for (const MemoryEntry& entry : entries)
        if (entry.name == "object 1 x") x = entry.value;
    EXPECT_NEAR(x, 4, 0.1);
}

TEST(Navigate, ItsPathIsAnnotatedAndTold) {
    const Scenario scenario = teamOf({{{{1, 1, 0}, {8, 4, 1}}}, {}}, Planner::visibilityGraph, Repair::wait);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    bool line = false, told = false;
    for (int tick = 0; tick < 2 * ticksPerSecond; ++tick) {
        StepTrace trace;
        step(scenario, state, buffers, {}, &trace);
        for (const Annotation& annotation : trace.robots[0].decision.annotations)
            if (annotation.kind == Annotation::Kind::line && annotation.label == "path") {
                line = true;
                EXPECT_EQ(annotation.points.back(), (Point{8, 4}));
            }
        for (const RadioMessage& message : trace.robots[0].decision.messages) told = told || message.size == 128;
    }
    EXPECT_TRUE(line);
    EXPECT_TRUE(told);
}

TEST(Navigate, WhereThereIsNoWayItSaysSoAndStands) {
    Team team{{{{1, 2.5, 0}, {8, 2.5, 0}}}, {}};
    for (int i = 0; i < 8; ++i) team.boxes.push_back({4, 0.35 + 0.6 * i, 0});
    const Scenario scenario = teamOf(team, Planner::visibilityGraph, Repair::wait);
    WorldState state = scenario.initialState();
    run(scenario, state, 5 * ticksPerSecond);
    EXPECT_EQ(explained(scenario.controller(0), scenario.memoryOf(state, 0)).front().text, "no way");
    EXPECT_LT(distance(position(state.robots[0].pose), {1, 2.5}), 0.1);
}

}  // namespace
}  // namespace mrose
