#include "plugin/load_plugin.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "plugin/plugin.h"
#include "plugin/test_plugins.h"
#include "support/observation_parts.h"
#include "support/temporary_folder.h"
#include "world/command_history.h"

namespace mrose {
namespace {

std::string refusal(const std::string& path, const std::string& options = "") {
    const auto loaded = loadPlugin(path, options);
    EXPECT_FALSE(loaded) << path;
    return loaded ? "" : loaded.error().message();
}

std::string faultOf(const std::string& what) {
    const auto loaded = loadPlugin(testPlugin("misbehaving"), how(what));
    EXPECT_TRUE(loaded) << loaded.error().message();
    if (!loaded) return "";
    std::vector<std::byte> memory((*loaded)->memorySize());
    Decision decision;
    (*loaded)->decide({}, memory, decision);
    EXPECT_FALSE(decision.command);
    EXPECT_TRUE(decision.earlier.empty());
    return decision.fault;
}

TEST(PluginLoading, ControllerDecidesAndRemembers) {
    const auto loaded = loadPlugin(testPlugin("well_behaved"), "speed_mps = 0.7\nkicks = true\nlabel = \"n\"\n");
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Controller& controller = **loaded;
    EXPECT_EQ((*loaded)->path(), testPlugin("well_behaved"));
    EXPECT_EQ(controller.commandsPerPeriod(100'000'000), 2u);
    EXPECT_EQ(controller.attention(), Attention::only({"self", "odometry", "robots", "messages"}));
    std::vector<std::byte> memory(controller.memorySize());
    controller.start(memory);
    ObservationParts observation;
    observation.velocity.w = 0.25;
    observation.manipulators = 1;
    for (int i = 1; i <= 5; ++i) {
        Decision decision;
        controller.decide(observation, memory, decision);
        EXPECT_EQ(decision.fault, "");
        ASSERT_TRUE(decision.command);
        EXPECT_EQ(decision.command->v, 0.7);
        EXPECT_NEAR(decision.command->w, 0.25 * i + 0.1, 1e-12);
        EXPECT_EQ(decision.kicks.size(), (100 + i) % 3 == 0 ? 1u : 0u);
        ASSERT_EQ(decision.annotations.size(), 2u);
        EXPECT_EQ(decision.annotations[0].label, "n");
        EXPECT_EQ(decision.annotations[0].value, 100 + i);
        EXPECT_EQ(decision.breakReason.empty(), i != 5);
    }
}

TEST(PluginLoading, ControllerExplainsItsMemory) {
    const auto loaded = loadPlugin(testPlugin("well_behaved"), "label = \"n\"\n");
    ASSERT_TRUE(loaded) << loaded.error().message();
    std::vector<std::byte> memory((*loaded)->memorySize());
    (*loaded)->start(memory);
    const auto entries = explained(**loaded, memory);
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_EQ(entries[0].name, "count");
    EXPECT_EQ(entries[0].value, 100);
    EXPECT_EQ(entries[1].unit, "rad");
    EXPECT_EQ(entries[2].text, "n");
    as<PluginMemory>(std::span(memory)).ended = 1;
    EXPECT_TRUE(explained(**loaded, memory).empty());
    const auto mute = loadPlugin(testPlugin("misbehaving"), how("explanation"));
    memory.assign((*mute)->memorySize(), {});
    ASSERT_EQ(explained(**mute, memory).size(), 1u);
    EXPECT_EQ(explained(**mute, memory)[0].text, "threw: no words");
}

TEST(PluginLoading, WhatIsNoPluginIsSaid) {
    const TemporaryFolder folder;
    const std::string missing = (folder.path() / "none.so").string();
    EXPECT_EQ(refusal(missing), missing + ": there is no such file");
    const std::string text = folder.write("text.so", "not a library, but a text of some length").string();
    EXPECT_EQ(refusal(text), text + ": cannot be loaded: file too short");
    EXPECT_NE(refusal(folder.path().string()).find("cannot be loaded: "), std::string::npos);
    EXPECT_EQ(refusal(testPlugin("no_plugin")),
              testPlugin("no_plugin") + ": is no plug-in: it has no mrosePlugin (MROSE_PLUGIN)");
    EXPECT_NE(refusal(testPlugin("unresolved")).find("cannot be loaded: undefined symbol: "), std::string::npos);
}

/// A library's name alone is a file of the current folder, and not one of the system's.
TEST(PluginLoading, NameAloneIsNoSystemLibrary) { EXPECT_EQ(refusal("libm.so.6"), "libm.so.6: there is no such file"); }

TEST(PluginLoading, WhatWasBuiltOtherwiseIsSaid) {
    EXPECT_EQ(refusal(testPlugin("other_interface")),
              testPlugin("other_interface") + ": was built for plug-in interface 0 and not " +
                  std::to_string(pluginInterface) + "; build it with the headers of this program");
    EXPECT_EQ(
        refusal(testPlugin("other_library")),
        testPlugin("other_library") + ": was built with libstdc++ with debugging containers and not with libstdc++");
    EXPECT_EQ(refusal(testPlugin("other_layout")),
              testPlugin("other_layout") + ": was built where Decision has " + std::to_string(sizeof(Decision) + 8) +
                  " bytes and not " + std::to_string(sizeof(Decision)) + "; build it with the headers of this program");
}

TEST(PluginLoading, OptionsAreStrict) {
    const auto key = [](const std::string& options) {
        const auto loaded = loadPlugin(testPlugin("well_behaved"), options);
        EXPECT_FALSE(loaded) << options;
        return loaded ? "" : loaded.error().key + ": " + loaded.error().cause;
    };
    EXPECT_EQ(key("speed_mps = 'fast'"), "speed_mps: expected a finite number");
    EXPECT_EQ(key("kicks = 1"), "kicks: expected true or false");
    EXPECT_EQ(key("label = 1"), "label: expected a text in quotes");
    EXPECT_EQ(key("speed = 1.0"), "speed: is not a known key; did you mean speed_mps?");
    EXPECT_EQ(key("speed_mps = -1.0"), "speed_mps: expected at least 0");
}

TEST(PluginLoading, WhatItThrowsWhileLoadingIsSaid) {
    const std::string path = testPlugin("misbehaving");
    EXPECT_EQ(refusal(path, how("construction")), path + ": its construction threw: no map?here");
    EXPECT_EQ(refusal(path, how("memory size")), path + ": its memorySize threw: how much?");
    EXPECT_EQ(refusal(path, how("start")), path + ": its start threw: not now");
    EXPECT_EQ(refusal(path, how("huge memory")),
              path + ": asks for 1099511627776 bytes of memory; at most 1048576 can be had");
    // What it threw may be why nothing asked for the rest.
    EXPECT_EQ(refusal(path, how("construction") + "more = 1\n"), path + ": its construction threw: no map?here");
}

TEST(PluginLoading, CommandsAPeriodAreWithinBounds) {
    const auto loaded = loadPlugin(testPlugin("well_behaved"), "");
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ((*loaded)->commandsPerPeriod(10'000'000), 1u);
    EXPECT_EQ((*loaded)->commandsPerPeriod(std::int64_t{1} << 60), CommandHistory::capacity);
}

TEST(PluginLoading, ControllerIsDestroyedWithTheLastOfItsUsers) {
    const TemporaryFolder folder;
    const std::filesystem::path farewell = folder.path() / "farewell";
    auto loaded = loadPlugin(testPlugin("misbehaving"), "farewell = '" + farewell.string() + "'\n");
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_FALSE(std::filesystem::exists(farewell));
    loaded->reset();
    EXPECT_TRUE(std::filesystem::exists(farewell));
}

TEST(PluginLoading, WhatItThrowsOrGivesWronglyIsAFault) {
    const std::string who = "its plug-in " + testPlugin("misbehaving");
    EXPECT_EQ(faultOf("throw"), who + " threw: index 7");
    EXPECT_EQ(faultOf("throw int"), who + " threw something that is no std::exception");
    EXPECT_EQ(faultOf("nan"), who + " gave a command that is not finite");
    EXPECT_EQ(faultOf("infinite earlier"), who + " gave a command that is not finite");
    EXPECT_EQ(faultOf("huge v"), who + " gave a command of 1e+160 m/s; expected at most 1000 m/s");
    EXPECT_EQ(faultOf("huge w"), who + " gave a command of -1e+200 rad/s; expected at most 1000 rad/s");
    EXPECT_EQ(faultOf("huge earlier"), who + " gave a command of 1001.0 rad/s; expected at most 1000 rad/s");
}

TEST(PluginLoading, RobotOfAFaultyPluginStandsAndTheRunGoesOn) {
    for (const std::string what : {"throw", "nan", "huge v", "huge w"}) {
        const auto faulty = loadPlugin(testPlugin("misbehaving"), how(what, 0.5));
        const auto good = loadPlugin(testPlugin("well_behaved"), "");
        ASSERT_TRUE(faulty && good);
        const Scenario scenario = drivenBy({*faulty, *good});
        WorldState state = scenario.initialState();
        EXPECT_TRUE(faultsOfRun(scenario, state, 25).empty());
        EXPECT_GT(state.robots[0].velocity_B.x, 0.2);
        const auto faults = faultsOfRun(scenario, state, 100);
        ASSERT_EQ(faults.size(), 20u);
        EXPECT_EQ(faults.front().robot, 0u);
        EXPECT_EQ(state.robots[0].velocity_B.x, 0);
        EXPECT_GT(state.robots[1].velocity_B.x, 0.2);
    }
}

}  // namespace
}  // namespace mrose
