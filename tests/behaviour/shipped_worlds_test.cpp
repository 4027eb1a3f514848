// What the scenarios that ship are for happens in them, over many seeds.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "scenario/description_file.h"
#include "scenario/scenario_file.h"
#include "simulation/step.h"
#include "support/places.h"

namespace mrose {
namespace {

constexpr double tickSeconds = 0.02;

Scenario shippedWorld(const std::string& name) {
    DiskDescriptions source({sourceFolder(), {}, ""});
    auto loaded = loadScenario(name, source);
    EXPECT_TRUE(loaded) << loaded.error().message();
    return Scenario(std::move(loaded->parts));
}

/// By robot, means over the runs.
struct Walks {
    std::vector<double> atWalls;  ///< s, in contact with what stands still
    std::vector<double> driven;   ///< m
};

Walks walksIn(const Scenario& scenario, int seeds, double duration) {
    const std::size_t robots = scenario.scene().robots.size();
    Walks walks{std::vector<double>(robots), std::vector<double>(robots)};
    for (int seed = 1; seed <= seeds; ++seed) {
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(seed));
        StepBuffers buffers;
        StepTrace trace;
        for (double time = 0; time < duration; time += tickSeconds) {
            const std::vector<RobotState> before = state.robots;
            step(scenario, state, buffers, {}, &trace);
            std::vector<bool> touches(robots);
            for (const ContactReport& contact : trace.contacts)
                if (contact.bodyB == noBody && contact.bodyA < robots) touches[contact.bodyA] = true;
            for (std::size_t i = 0; i < robots; ++i) {
                walks.atWalls[i] += touches[i] ? tickSeconds / seeds : 0;
                walks.driven[i] += distance(position(before[i].pose), position(state.robots[i].pose)) / seeds;
            }
        }
    }
    return walks;
}

/// They walk, and hardly ever along a wall's face.
TEST(ShippedWorlds, PeopleOfTheCorridorKeepOffItsWallsAndGetOn) {
    const Scenario scenario = shippedWorld("b21_corridor.toml");
    const Walks walks = walksIn(scenario, 20, 120);
    for (std::size_t i = 0; i < walks.atWalls.size(); ++i) {
        const std::string& name = scenario.scene().robots[i].name;
        EXPECT_LT(walks.atWalls[i], 0.3) << name << ", s of two minutes";
        EXPECT_GT(walks.driven[i], 30) << name << ", m of two minutes";
    }
}

/// Goals on both sides; games without any are the exception.
TEST(ShippedWorlds, SoccerIsALivelyGame) {
    const Scenario scenario = shippedWorld("soccer.toml");
    constexpr int games = 30, ticks = 60 * 50;
    int scoreless = 0;
    std::vector<int> goals(2);
    for (int seed = 1; seed <= games; ++seed) {
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(seed));
        StepBuffers buffers;
        for (int tick = 0; tick < ticks; ++tick) step(scenario, state, buffers);
        ASSERT_EQ(state.goals.size(), goals.size());
        for (std::size_t i = 0; i < goals.size(); ++i) goals[i] += state.goals[i];
        scoreless += state.goals[0] + state.goals[1] == 0 ? 1 : 0;
    }
    EXPECT_GE(goals[0] + goals[1], games);
    EXPECT_GE(std::min(goals[0], goals[1]), games / 5) << "one side alone";
    EXPECT_LE(scoreless, games / 3);
}

}  // namespace
}  // namespace mrose
