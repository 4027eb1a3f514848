// What the scenarios that ship are for happens in them, over many seeds.
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "io/file.h"
#include "scenario/description_file.h"
#include "scenario/scenario_file.h"
#include "simulation/step.h"
#include "support/places.h"
#include "support/temporary_folder.h"

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
    std::vector<double> atWalls;  ///< s, in contact with what stands still, while walking
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
                const double way = distance(position(before[i].pose), position(state.robots[i].pose));
                walks.atWalls[i] += touches[i] && way > 0.1 * tickSeconds ? tickSeconds / seeds : 0;
                walks.driven[i] += way / seeds;
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

/// What the B21 of the corridor does in so many runs of two minutes. What touches it again within a second touches it
/// once.
struct Strolls {
    double wallsPerHour = 0, peoplePerHour = 0;
    double runsIntoPerHour = 0;  ///< of those with people: it drives, and they are ahead
    double waypoints = 0;        ///< reached, mean of a run
};

Strolls strollsIn(const Scenario& scenario, int seeds) {
    constexpr double minutes = 2;
    Strolls strolls;
    for (int seed = 1; seed <= seeds; ++seed) {
        WorldState state = scenario.initialState(static_cast<std::uint64_t>(seed));
        StepBuffers buffers;
        StepTrace trace;
        std::map<std::uint32_t, std::int64_t> touched;
        double end = 8.5;
        while (state.tick * tickSeconds < 60 * minutes) {
            step(scenario, state, buffers, {}, &trace);
            const RobotState& b21 = state.robots[0];
            for (const ContactReport& contact : trace.contacts) {
                if (contact.bodyA != 0 && contact.bodyB != 0) continue;
                const std::uint32_t other = contact.bodyA == 0 ? contact.bodyB : contact.bodyA;
                const bool again = touched.contains(other) && (state.tick - touched[other]) * tickSeconds < 1;
                touched[other] = state.tick;
                if (again) continue;
                const double bearing = direction(Placement(b21.pose).placeBack(contact.position));
                if (other == noBody) ++strolls.wallsPerHour;
                if (other >= state.robots.size()) continue;
                ++strolls.peoplePerHour;
                strolls.runsIntoPerHour += std::abs(bearing) < 1.2 && b21.velocity_B.x > 0.05 ? 1 : 0;
            }
            if (std::abs(b21.pose.x - end) > 0.5) continue;
            ++strolls.waypoints;
            end = -end;
        }
    }
    for (double* rate : {&strolls.wallsPerHour, &strolls.peoplePerHour, &strolls.runsIntoPerHour})
        *rate *= 60 / (minutes * seeds);
    strolls.waypoints /= seeds;
    return strolls;
}

/// The corridor with a B21 that has only some of its sensors.
Scenario corridorWith(const std::vector<std::string>& sensors) {
    const auto textOf = [](const char* file) { return readFile(sourceFolder() / file).value_or(""); };
    const TemporaryFolder folder;
    const std::string robot = textOf("resources/robots/b21.toml"), begin = "[[sensor]]";
    std::size_t at = robot.find(begin);
    std::string kept = robot.substr(0, at);
    while (at != std::string::npos) {
        const std::size_t next = robot.find(begin, at + 1);
        const std::string one = robot.substr(at, next == std::string::npos ? next : next - at);
        for (const std::string& name : sensors)
            if (one.find("name = \"" + name + '"') != std::string::npos) kept += one;
        at = next;
    }
    folder.write("some.toml", kept);
    std::string text = textOf("resources/scenarios/b21_corridor.toml");
    const std::string type = "type = \"b21.toml\"";
    text.replace(text.find(type), type.size(), "type = \"some.toml\"");
    return shippedWorld(folder.write("corridor.toml", text).string());
}

/// Among people who walk at 1.2 m/s and look only ahead: core/behaviour/README.md has what was measured over more runs.
TEST(ShippedWorlds, B21FindsItsWayAmongPeopleByItsSensors) {
    const Strolls strolls = strollsIn(shippedWorld("b21_corridor.toml"), 50);
    EXPECT_LT(strolls.wallsPerHour, 1.5);
    EXPECT_LT(strolls.peoplePerHour, 32);
    EXPECT_LT(strolls.runsIntoPerHour, 6);
    EXPECT_GT(strolls.waypoints, 1.6);
}

TEST(ShippedWorlds, B21FindsItsWayByEachOfItsSensorsAloneAndTouchesMore) {
    const Strolls laser = strollsIn(corridorWith({"laser"}), 20), sonar = strollsIn(corridorWith({"sonar"}), 20);
    EXPECT_LT(laser.wallsPerHour, 3);
    EXPECT_LT(sonar.wallsPerHour, 12) << "edges send no sound back";
    for (const Strolls& strolls : {laser, sonar}) EXPECT_GT(strolls.waypoints, 1.5);
    EXPECT_LT(laser.peoplePerHour, 55);
    EXPECT_LT(sonar.peoplePerHour, 110);
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
