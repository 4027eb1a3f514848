#include "behaviour/method_choice.h"

#include <cmath>

#include <gtest/gtest.h>

#include "behaviour/navigate.h"
#include "behaviour/small_field.h"

namespace mrose {
namespace {

const std::vector<TeamMethod> twoMethods{{Planner::visibilityGraph, Repair::wait, true},
                                         {Planner::visibilityGraph, Repair::imaginedObstacle, false}};

/// By which the time of a method is what its plans say; and of the second so much more.
class PlansAreRight final : public LearnedMapping {
public:
    explicit PlansAreRight(double more) : more_(more) {}
    std::size_t inputs() const override { return 2; }
    std::size_t outputs() const override { return 2; }
    MappingVariable input(std::size_t index) const override { return {index == 0 ? "rests_1" : "rests_2", "s"}; }
    MappingVariable output(std::size_t) const override { return {"method", "s"}; }
    void evaluate(std::span<const double> from, std::span<double> to) const override {
        to[0] = from[0];
        to[1] = from[1] + more_;
    }
    double beyond(std::span<const double> from) const override { return from[0] > 10 ? 0.5 : 0; }

private:
    double more_;
};

MethodChoice::Options choosing(double more) {
    MethodChoice::Options options{
        .methods = twoMethods, .time = std::make_shared<const PlansAreRight>(more), .inputs = {}};
    for (const char* const name : {"rests_1", "rests_2"})
        options.inputs.push_back(*MethodChoice::input(name, twoMethods.size()));
    return options;
}

std::string textOf(const std::vector<MemoryEntry>& entries, std::string_view name) {
    for (const MemoryEntry& entry : entries)
        if (entry.name == name) return entry.text;
    return "none";
}
double valueOf(const std::vector<MemoryEntry>& entries, std::string_view name) {
    for (const MemoryEntry& entry : entries)
        if (entry.name == name) return entry.value;
    return std::numeric_limits<double>::infinity();
}

/// Three whose ways cross, of one team, which choose so.
Scenario crossing(const MethodChoice::Options& choice) {
    static const Environment field = walledField(9, 5);
    SmallWorld world(field);
    const std::pair<Pose, Pose> ways[]{
        {{1.5, 2.5, 0}, {7.5, 2.5, 0}}, {{4.5, 0.7, 1.57}, {4.5, 4.3, 1.57}}, {{7.5, 1, 3.1}, {2, 4, 3.1}}};
    Perception perception;
    perception.self.noise = {0.01, 0.01, 0.01};
    for (const auto& [start, target] : ways)
        world.robot(guideRobot(perception), start,
                    std::make_shared<const Navigate>(Navigate::Options{.target = target,
                                                                       .method = {.planner = Planner::viaPoints},
                                                                       .choice = choice,
                                                                       .radius = 0.31,
                                                                       .objectRadius = 0.22,
                                                                       .walls = floorPlanOf(field)}),
                    noisyDrive(), 3);
    world.object(boxType(0.3, 80), {3, 1, 0});
    return world.scenario();
}

std::vector<MemoryEntry> entriesOf(const Scenario& scenario, const WorldState& state, std::size_t robot) {
    return explained(scenario.controller(robot), scenario.memoryOf(state, robot));
}

TEST(MethodChoice, TheFirstRobotChoosesByItsPlansAndTheOthersFollow) {
    for (const double more : {-100.0, 100.0}) {
        const Scenario scenario = crossing(choosing(more));
        WorldState state = scenario.initialState();
        run(scenario, state, ticksPerSecond / 5);
        EXPECT_EQ(textOf(entriesOf(scenario, state, 0), "method"), "via_points+wait+lowest") << "it listens first";
        run(scenario, state, ticksPerSecond);
        const std::string expected = nameOf(twoMethods[more < 0 ? 1 : 0]);
        for (std::size_t robot = 0; robot < 3; ++robot) {
            const auto entries = entriesOf(scenario, state, robot);
            EXPECT_EQ(textOf(entries, "method"), expected) << robot;
            EXPECT_EQ(valueOf(entries, "considered"), robot == 0 ? 2 : 0);
        }
        const auto first = entriesOf(scenario, state, 0);
        EXPECT_EQ(valueOf(first, "robots"), 3);
        EXPECT_EQ(valueOf(first, "objects"), 1);
        EXPECT_NEAR(valueOf(first, "expected_2"), valueOf(first, "rests_2") + more, 1e-9);
    }
}

/// What it estimates are the plans of the whole team from where they are: noise of a centimetre away.
TEST(MethodChoice, EstimatesAreThePlansOfTheTeamThatItHeard) {
    const Scenario scenario = crossing({.methods = twoMethods, .time = nullptr, .inputs = {}});
    WorldState state = scenario.initialState();
    run(scenario, state, ticksPerSecond / 2);
    const auto entries = entriesOf(scenario, state, 0);
    EXPECT_EQ(valueOf(entries, "chosen"), 0);
    EXPECT_EQ(textOf(entries, "method"), "via_points+wait+lowest") << "nothing says which is best";
    std::vector<ConvexPiece> pieces = floorPlanOf(walledField(9, 5))->pieces();
    pieces.push_back(ConvexPiece::circle({3, 1}, 0.22));
    const std::vector<TeamMember> team{
        {{1.5, 2.5, 0}, {7.5, 2.5, 0}}, {{4.5, 0.7, 1.57}, {4.5, 4.3, 1.57}}, {{7.5, 1, 3.1}, {2, 4, 3.1}}};
    const DiscSpace space(std::move(pieces), 0.37);
    for (std::size_t k = 0; k < 2; ++k) {
        const TeamEstimate plan =
            teamPlan(team, space, twoMethods[k], {.heading = 0, .speed = 0.38, .rotation = 1, .begin = 0.3}, 0.68)
                .estimate;
        const std::string number = '_' + std::to_string(k + 1);
        EXPECT_NEAR(valueOf(entries, "rests" + number), plan.rests, 0.5);
        EXPECT_NEAR(valueOf(entries, "length" + number), plan.length, 0.3);
        EXPECT_EQ(valueOf(entries, "unclear" + number), plan.unclear);
    }
}

TEST(MethodChoice, WhatWasNotConsideredIsNotKnown) {
    const Scenario scenario = crossing(choosing(0));
    const WorldState state = scenario.initialState();
    const auto entries = entriesOf(scenario, state, 0);
    EXPECT_TRUE(std::isnan(valueOf(entries, "rests_1")));
    EXPECT_TRUE(std::isnan(valueOf(entries, beyondLearned)));
}

TEST(MethodChoice, InputsAreOfTheTeamOrOfAMethod) {
    for (const char* const name : {"robots", "objects", "rests_1", "stuck_2", "nearest_2"})
        EXPECT_TRUE(MethodChoice::input(name, 2)) << name;
    for (const char* const name : {"", "boxes", "rests", "rests_", "rests_0", "rests_3", "rests_1x", "_1", "sum_1"})
        EXPECT_FALSE(MethodChoice::input(name, 2)) << name;
}

}  // namespace
}  // namespace mrose
