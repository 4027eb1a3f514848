// Scenarios that begin in a state saved from a run.
#include "scenario/saved_state.h"

#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "io/file.h"
#include "scenario/descriptions.h"
#include "scenario/state_scenario.h"
#include "scenario/variation.h"
#include "simulation/step.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "world/state_bytes.h"
#include "world/state_difference.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

constexpr std::int64_t savedAt = 150;

Expected<LoadedScenario> loadFromDisk(const std::filesystem::path& path) {
    DiskDescriptions source({sourceFolder(), {}, ""});
    return loadScenario(path.string(), source);
}

class SavedStates : public testing::Test {
protected:
    /// A run of a scenario, up to where it is saved.
    void open(const std::map<std::string, std::string>& texts) { open(loadFrom(texts)); }
    void open(const Expected<LoadedScenario>& loaded) {
        ASSERT_TRUE(loaded) << loaded.error().message();
        value = std::make_shared<const ScenarioValue>(loaded->value);
        scenario.emplace(loaded->parts);
        state = scenario->initialState(23);
        StepBuffers buffers;
        while (state.tick < savedAt) step(*scenario, state, buffers);
    }
    Expected<void> save(const std::filesystem::path& path) const {
        DiskDescriptions disk({sourceFolder(), {}, ""});
        return saveStateAsScenario(path, *value, *scenario, state, disk);
    }
    /// The scenario in that file goes on as the run does.
    void expectGoesOn(const std::filesystem::path& path) {
        const auto loaded = loadFromDisk(path);
        ASSERT_TRUE(loaded) << loaded.error().message();
        const Scenario again(loaded->parts);
        WorldState then = state, now = again.initialState();
        const auto difference = firstDifference(then, now);
        ASSERT_FALSE(difference) << difference->message();
        StepBuffers buffers;
        for (int i = 0; i < 600; ++i) {
            step(*scenario, then, buffers);
            step(again, now, buffers);
            ASSERT_EQ(hashOf(then), hashOf(now)) << then.tick;
        }
    }
    std::vector<std::string> listing(const std::string& of) const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path() / of))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }
    /// What loading says where a part of the scenario's text, or of the state's, is another one.
    std::string refused(const std::string& from, const std::string& to) {
        std::map<std::string, std::string> texts = smallWorld();
        texts["s.toml"].insert(texts["s.toml"].find("environment"), "initial_state = \"x.state\"\n");
        texts["x.state"] = savedStateText(savedState(*scenario, state));
        bool changed = from.empty();
        for (const char* const name : {"s.toml", "x.state", "e.toml"}) {
            const std::size_t at = texts[name].find(from);
            if (changed || at == std::string::npos) continue;
            texts[name].replace(at, from.size(), to);
            changed = true;
        }
        EXPECT_TRUE(changed) << from;
        const auto loaded = loadFrom(texts);
        return loaded ? "" : loaded.error().message();
    }

    TemporaryFolder folder;
    ScenarioValuePointer value;
    std::optional<Scenario> scenario;
    WorldState state;
};

TEST_F(SavedStates, ComeBackToTheBit) {
    open(smallWorld());
    const SavedState saved = savedState(*scenario, state);
    const auto read = parseSavedState(savedStateText(saved), "x.state");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(stateBytes(read->state), stateBytes(state));
    EXPECT_EQ(read->robots, saved.robots);
    EXPECT_EQ(read->objects, saved.objects);
    EXPECT_EQ(read->scenario, "small");
    EXPECT_LT(savedStateText(saved).size(), 2 * stateBytes(state).size() + 1000);
}

/// What ships is named as it was.
TEST_F(SavedStates, ShippedScenarioGoesOnFromAnywhere) {
    DiskDescriptions source({sourceFolder(), {}, ""});
    open(loadScenario("soccer.toml", source));
    const auto saved = save(folder.path() / "later.toml");
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_EQ(listing("."), (std::vector<std::string>{"later.state", "later.toml"}));
    expectGoesOn(folder.path() / "later.toml");
    const auto text = readFile(folder.path() / "later.toml");
    // Who edits a start reads first what holds.
    EXPECT_TRUE(text->starts_with("# The run goes on from `initial_state`, which holds.")) << *text;
    for (const char* const line : {"\n[variation]\n", "\ninitial_state = \"later.state\"\n",
                                   "\nenvironment = \"midsize_2001.toml\"\n", "\nseed = 23\n"})
        EXPECT_NE(text->find(line), std::string::npos) << line;
    // And saved again from there.
    const auto later = loadFromDisk(folder.path() / "later.toml");
    value = std::make_shared<const ScenarioValue>(later->value);
    scenario.emplace(later->parts);
    state = stepped(*scenario, scenario->initialState());
    ASSERT_TRUE(save(folder.path() / "again.toml"));
    expectGoesOn(folder.path() / "again.toml");
}

/// Texts that lie nowhere on the disk, as of a recording, are written beside.
TEST_F(SavedStates, WhatIsNotOnTheDiskIsWrittenBeside) {
    open(smallWorld());
    std::filesystem::create_directories(folder.path() / "new");
    const auto saved = save(folder.path() / "new" / "later.toml");
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_EQ(listing("new"),
              (std::vector<std::string>{"later.state", "later.toml", "later_ball.toml", "later_disc.toml",
                                        "later_e.toml", "later_learned.toml", "later_n.net", "later_r.toml"}));
    expectGoesOn(folder.path() / "new" / "later.toml");
}

TEST_F(SavedStates, WhatIsOnTheDiskIsNamedWhereItLies) {
    for (const auto& [name, text] : smallWorld()) folder.write("old/" + name, text);
    open(loadFromDisk(folder.path() / "old" / "s.toml"));
    std::filesystem::create_directories(folder.path() / "new");
    ASSERT_TRUE(save(folder.path() / "new" / "later.toml"));
    EXPECT_EQ(listing("new"), (std::vector<std::string>{"later.state", "later.toml"}));
    expectGoesOn(folder.path() / "new" / "later.toml");
    // Where one has been changed since, it and the robots that name it are written beside.
    folder.write("old/disc.toml", "# changed\n");
    ASSERT_TRUE(save(folder.path() / "new" / "later.toml"));
    EXPECT_EQ(listing("new"), (std::vector<std::string>{"later.state", "later.toml", "later_disc.toml",
                                                        "later_learned.toml", "later_r.toml"}));
    expectGoesOn(folder.path() / "new" / "later.toml");
}

/// Friction and masses of a trial are its own; those of the scenario are written beside.
TEST_F(SavedStates, TrialGoesOnWithItsFrictionAndMasses) {
    const auto base =
        loadFrom(changedWorld("s.toml", "kick_off = false", "variation = { friction_share = 0.5, mass_share = 0.3 }"));
    ASSERT_TRUE(base) << base.error().message();
    open(varied(*base, 3));
    const double friction = scenario->scene().environment.floor.slidingFriction;
    ASSERT_NE(friction, base->parts.scene.environment.floor.slidingFriction);
    ASSERT_TRUE(save(folder.path() / "later.toml"));
    expectGoesOn(folder.path() / "later.toml");
    const auto later = loadFromDisk(folder.path() / "later.toml");
    EXPECT_EQ(later->parts.scene.environment.floor.slidingFriction, friction);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(later->parts.scene.typeOfObject(i).mass, scenario->scene().typeOfObject(i).mass);
}

TEST_F(SavedStates, WhatWouldGoOnOtherwiseIsNotSaved) {
    open(changedWorld("s.toml", "kick_off = false", "variation = { friction_share = 0.5 }"));
    scenario.emplace(*varied(scenario->parts(), 3));
    const auto saved = save(folder.path() / "later.toml");
    ASSERT_FALSE(saved);
    EXPECT_NE(saved.error().message().find("would not go on as the run does"), std::string::npos);
    open(smallWorld());
    EXPECT_FALSE(save(folder.path() / "none" / "later.toml"));
    EXPECT_FALSE(save(folder.path() / "later.state"));
    EXPECT_TRUE(listing(".").empty());
}

TEST_F(SavedStates, MistakesAreNamed) {
    open(smallWorld());
    EXPECT_EQ(refused("", ""), "");
    EXPECT_EQ(refused("\"x.state\"", "\"y.state\""),
              "s.toml:4:17: initial_state: \"y.state\" was not found; expected y.state or "
              "mrose:resources/scenarios/y.state");
    EXPECT_EQ(refused("name = \"one\"", "name = \"eleven\""),
              "s.toml:4:17: initial_state: is a state of \"small\" with the robot \"one\" where the scenario has "
              "\"eleven\"");
    EXPECT_EQ(refused("name = \"crate\"", "name = \"box\""),
              "s.toml:4:17: initial_state: is a state of \"small\" with the object \"crate\" where the scenario has "
              "\"box\"");
    EXPECT_EQ(refused("tick_s = 0.02", "tick_s = 0.01"),
              "s.toml:4:17: initial_state: is a state of \"small\" with ticks of 0.02 s; the scenario's are 0.01 s");
    EXPECT_EQ(refused("[[goal]]\nname = \"east\"",
                      "[[goal]]\nname = \"x\"\narea_m = [[4, -1], [5, -1], [5, 1]]\n[[goal]]\nname = \"east\""),
              "s.toml:4:17: initial_state: is a state of \"small\" with 1 goals; the scenario has 2");
    EXPECT_EQ(refused("format = \"mrose state\"", "format = \"mrose robot\"").substr(0, 22), "x.state:2:10: format: ");
    EXPECT_EQ(refused("state = \"\"\"\n", "state = \"\"\"\n?"), "x.state:7:9: state: is damaged: it is not base64");
    EXPECT_TRUE(refused("state = \"\"\"\n", "state = \"\"\"\nAAAA").starts_with("x.state:7:9: state: is damaged: it "));
    EXPECT_EQ(refused("tick = 150", "tick = 151"), "x.state:5:8: tick: is not the state's, 150");
    EXPECT_EQ(refused("memory = 8", "memory = 40"),
              "x.state:7:9: state: holds other bodies, commands or memory than are listed beside it");
    EXPECT_NE(refused("tick_ns = 20000000", "tick_ns = 20000000\nx = 1").find("x: is not a known key"),
              std::string::npos);
    for (RobotState& robot : state.robots) robot.nextControl = std::int64_t{1} << 40;
    const std::int64_t tick = std::exchange(state.tick, latestTime / 20'000'000 + 1);
    EXPECT_EQ(refused("", ""), "x.state:7:9: state: is of no tick");
    state.tick = tick;
    state.robots[1].pose.x = std::nan("");
    EXPECT_EQ(
        refused("", ""),
        "s.toml:4:17: initial_state: does not fit the scenario: it has a number that is not finite, or beyond all "
        "that occurs");
    state.robots[1].pose.x = -2e9;
    EXPECT_NE(refused("", "").find("a number that is not finite, or beyond all that occurs"), std::string::npos);
    state.robots[1].pose.x = 0;
    state.robots[1].segment.startTick = tick + 1;
    EXPECT_NE(refused("", "").find("an instant beyond all runs, or a motion that has yet to begin"), std::string::npos);
    state.robots[1].segment.startTick = tick;
    state.robots[1].lastControl = tick + 1;
    EXPECT_NE(refused("", "").find("an instant beyond all runs"), std::string::npos);
    state.robots[1].lastControl = tick;
    const std::int64_t next = std::exchange(state.robots[1].nextControl, latestTime + 1);
    EXPECT_NE(refused("", "").find("an instant beyond all runs"), std::string::npos);
    state.robots[1].nextControl = next;
    state.robots[2].ready[0] = std::numeric_limits<Nanoseconds>::min();
    EXPECT_NE(refused("", "").find("an instant beyond all runs"), std::string::npos);
    state.robots[2].ready[0] = 0;
    state.robots[2].commandCount = 1000;
    EXPECT_EQ(refused("", ""), "x.state:7:9: state: is broken in robot \"three\"");
}

/// Trials move the bodies from where the state has them, with their way and their past; all else is the state's.
TEST_F(SavedStates, TrialsMoveItsBodies) {
    open(changedWorld("s.toml", "kick_off = false",
                      "variation = { robot_position_m = 0.2, robot_heading_deg = 20, object_position_m = 0.1 }"));
    ASSERT_TRUE(save(folder.path() / "later.toml"));
    const auto loaded = loadFromDisk(folder.path() / "later.toml");
    EXPECT_FALSE(firstDifference(Scenario(*varied(loaded->parts, 0)).initialState(), state));
    const Scenario trial(*varied(loaded->parts, 3));
    const auto trialValue = varied(*loaded, 3);
    ASSERT_TRUE(trialValue);
    const auto fromValue = loadScenario(trialValue->value);
    ASSERT_TRUE(fromValue) << fromValue.error().message();
    EXPECT_FALSE(firstDifference(Scenario(fromValue->parts).initialState(), trial.initialState()));
    const WorldState moved = trial.initialState();
    EXPECT_EQ(moved.tick, savedAt);
    EXPECT_EQ(moved.commands.size(), state.commands.size());
    EXPECT_EQ(moved.memory, state.memory);
    for (std::size_t i = 0; i < 3; ++i) {
        const Pose &now = moved.robots[i].pose, &then = state.robots[i].pose;
        EXPECT_NE(now, then);
        EXPECT_LE(std::abs(now.x - then.x), 0.2);
        EXPECT_LE(std::abs(now.heading - then.heading), 20 * 3.15 / 180);
        EXPECT_EQ(moved.robots[i].velocity_B, state.robots[i].velocity_B);
        const Pose way = relative(now, moved.robots[i].segment.start),
                   was = relative(then, state.robots[i].segment.start);
        EXPECT_NEAR(way.x, was.x, 1e-12);
        EXPECT_NEAR(way.y, was.y, 1e-12);
        const Pose past = relative(now, trial.poseBefore(moved, i, 4)),
                   before = relative(then, scenario->poseBefore(state, i, 4));
        EXPECT_NEAR(past.x, before.x, 1e-12);
        EXPECT_NEAR(past.heading, before.heading, 1e-12);
    }
    EXPECT_EQ(moved.objects[0].velocity_W, state.objects[0].velocity_W);
    // After a goal the ball still goes where the file says.
    EXPECT_EQ(trial.kickOffPose(0), scenario->kickOffPose(0));
    WorldState next = moved;
    StepBuffers buffers;
    step(trial, next, buffers);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LT(
            std::hypot(next.robots[i].pose.x - moved.robots[i].pose.x, next.robots[i].pose.y - moved.robots[i].pose.y),
            0.03)
            << "no robot jumps back";
}

/// Another model or controller takes what suits it.
TEST_F(SavedStates, SwappedModelsGoOnFromIt) {
    open(smallWorld());
    ASSERT_TRUE(save(folder.path() / "later.toml"));
    const auto loaded = loadFromDisk(folder.path() / "later.toml");
    const auto swapped = loaded->value.with(loaded->value.bodyPath("one") + ".network", "later_n.net");
    ASSERT_TRUE(swapped);
    DiskDescriptions disk({sourceFolder(), {}, ""});
    const auto again = loadScenario(*swapped, disk);
    ASSERT_TRUE(again) << again.error().message();
    const Scenario other(again->parts);
    const WorldState begun = other.initialState();
    EXPECT_EQ(begun.robots[0].pose, state.robots[0].pose);
    EXPECT_EQ(begun.memory, state.memory);
    const Nanoseconds now = 20'000'000 * savedAt;
    for (Nanoseconds age = 0; age < 200'000'000; age += 10'000'000)
        EXPECT_EQ(other.commandsOf(begun, 0).at(now - age), scenario->commandsOf(state, 0).at(now - age));
}

/// A sensor that came, one that went, and one that stands elsewhere among them.
TEST_F(SavedStates, SensorsAreMatchedByTheirNames) {
    const auto with = [](const std::vector<std::string>& names) {
        std::string sensors;
        for (const std::string& name : names)
            sensors += "[[sensor]]\nkind = \"localisation\"\nname = \"" + name + "\"\nbias = { x_m = 0.1 }\n";
        std::map<std::string, std::string> texts = smallWorld();
        texts["r.toml"] += sensors;
        return texts;
    };
    open(with({"gone", "gps", "odd"}));
    const SavedState saved = savedState(*scenario, state);
    const auto read = parseSavedState(savedStateText(saved), "x.state");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->robots, saved.robots);
    const auto loaded = loadFrom(with({"odd", "new", "gps"}));
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Scenario other(loaded->parts);
    const WorldState begun = restored(*read, other, 23);
    const auto now = [&](std::size_t sensor) { return other.sensorMemory(begun, 0, 3 + sensor); };
    const auto then = [&](std::size_t sensor) { return scenario->sensorMemory(std::as_const(state), 0, 3 + sensor); };
    EXPECT_TRUE(std::ranges::equal(now(0), then(2)));
    EXPECT_TRUE(std::ranges::equal(now(2), then(1)));
    EXPECT_FALSE(std::ranges::equal(now(0), now(2))) << "each has a bias of its own";
    EXPECT_TRUE(std::ranges::all_of(now(1), [](std::byte byte) { return byte == std::byte{0}; }));
}

}  // namespace
}  // namespace mrose
