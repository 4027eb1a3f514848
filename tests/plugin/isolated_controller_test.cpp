#include "plugin/isolated_controller.h"

#include <cerrno>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "plugin/load_plugin.h"
#include "plugin/test_plugins.h"
#include "support/observation_parts.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

std::shared_ptr<const Controller> isolated(const std::string& name, const std::string& options, double limit = 60) {
    const auto loaded = isolatePlugin(testPlugin(name), options, isolation(limit));
    EXPECT_TRUE(loaded) << loaded.error().message();
    return loaded ? *loaded : nullptr;
}
std::shared_ptr<const Controller> loaded(const std::string& name, const std::string& options) {
    const auto plugin = loadPlugin(testPlugin(name), options);
    EXPECT_TRUE(plugin) << plugin.error().message();
    return plugin ? *plugin : nullptr;
}
std::string refusal(const std::string& path, const std::string& options, const IsolationOptions& options2) {
    const auto plugin = isolatePlugin(path, options, options2);
    EXPECT_FALSE(plugin);
    return plugin ? "" : plugin.error().message();
}

class Isolation : public testing::Test {
protected:
    /// Neither a process nor a zombie is left.
    void TearDown() override { EXPECT_TRUE(::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD); }
};

/// Three robots, each in a process of its own, against the same three in this one: every state is the same, memory
/// included.
TEST_F(Isolation, DecidesAsInTheProgram) {
    const std::string fast = "speed_mps = 0.9\nkicks = true\n", slow = "speed_mps = 0.2\n";
    const Scenario apart = drivenBy(
        {isolated("well_behaved", fast), isolated("well_behaved", slow), isolated("misbehaving", how("throw", 0.7))});
    const Scenario together = drivenBy(
        {loaded("well_behaved", fast), loaded("well_behaved", slow), loaded("misbehaving", how("throw", 0.7))});
    WorldState a = apart.initialState(), b = together.initialState();
    StepTrace traceA, traceB;
    StepBuffers buffers;
    for (int i = 0; i < 200; ++i) {
        step(apart, a, buffers, {}, &traceA);
        step(together, b, buffers, {}, &traceB);
        const auto difference = firstDifference(a, b);
        ASSERT_FALSE(difference) << difference->message();
        ASSERT_EQ(traceA.faults.size(), traceB.faults.size());
        for (std::size_t f = 0; f < traceA.faults.size(); ++f) EXPECT_EQ(traceA.faults[f].what, traceB.faults[f].what);
        EXPECT_EQ(traceA.robots[0].decision.annotations.size(), traceB.robots[0].decision.annotations.size());
        EXPECT_EQ(traceA.robots[0].decision.breakReason, traceB.robots[0].decision.breakReason);
    }
    EXPECT_GT(a.robots[0].pose.x, 1);
}

TEST_F(Isolation, ReadingWhatItsAttentionLeavesOutIsAFault) {
    for (const std::string what : {"robots", "scan"})
        for (const bool apart : {false, true}) {
            const std::string options = how("unasked " + what, 0.1);
            const Scenario scenario =
                drivenBy({apart ? isolated("misbehaving", options) : loaded("misbehaving", options)});
            WorldState state = scenario.initialState();
            const auto faults = faultsOfRun(scenario, state, 20);
            ASSERT_FALSE(faults.empty());
            EXPECT_NE(faults[0].what.find("it reads '" + what + "', which its attention() leaves out"),
                      std::string::npos)
                << faults[0].what;
        }
}

TEST_F(Isolation, ExplainsAsInTheProgram) {
    const auto apart = isolated("well_behaved", "label = \"n\"\n"), here = loaded("well_behaved", "label = \"n\"\n");
    std::vector<std::byte> memory(apart->memorySize());
    apart->start(memory);
    Decision decision;
    apart->decide({}, memory, decision);
    const auto entries = explained(*apart, memory), expected = explained(*here, memory);
    ASSERT_EQ(entries.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(entries[i].name, expected[i].name);
        EXPECT_EQ(entries[i].value, expected[i].value);
        EXPECT_EQ(entries[i].unit, expected[i].unit);
        EXPECT_EQ(entries[i].text, expected[i].text);
    }
}

/// What it dies of when it is looked at does no harm to the run.
TEST_F(Isolation, DeadExplanationIsSaid) {
    const auto controller = isolated("misbehaving", how("crash when asked to explain"));
    std::vector<std::byte> memory(controller->memorySize());
    controller->start(memory);
    for (int i = 0; i < 2; ++i) {
        ASSERT_EQ(explained(*controller, memory).size(), 1u);
        EXPECT_EQ(explained(*controller, memory)[0].name, "explain");
        EXPECT_NE(explained(*controller, memory)[0].text, "");
        Decision decision;
        controller->decide({}, memory, decision);
        EXPECT_EQ(decision.fault, "");
    }
}

TEST_F(Isolation, WhatCannotBeLoadedIsSaid) {
    EXPECT_EQ(refusal("/none.so", "", isolation()), "/none.so: there is no such file");
    const std::string path = testPlugin("misbehaving"), well = testPlugin("well_behaved");
    EXPECT_EQ(refusal(path, how("construction"), isolation()), path + ": its construction threw: no map?here");
    EXPECT_EQ(refusal(well, "speed = 1.0", isolation()), well + ": speed: is not a known key; did you mean speed_mps?");
    EXPECT_EQ(refusal(path, how("crash while loading"), isolation()),
              path + ": its process ended by signal 11 (Segmentation fault) while it was loaded");
    IsolationOptions hasty = isolation();
    hasty.loadingLimit = 0.3;
    EXPECT_EQ(refusal(path, how("loop while loading"), hasty),
              path + ": its process took longer than 0.3 s while it was loaded");
    EXPECT_EQ(refusal(path, "", {{"/none/mrose"}, 60, 60}),
              "/none/mrose: cannot be started: No such file or directory");
    EXPECT_EQ(refusal(path, "", {{"/bin/true"}, 60, 60}),
              path + ": its process ended with status 0 while it was loaded");
    EXPECT_EQ(
        refusal(path, "",
                {{"/bin/sh", "-c", "head -c 4 <&3 >/dev/null; printf '\\003\\000\\000\\000abc' >&3", "sh"}, 60, 60}),
        path + ": its process answered what cannot be read");
    EXPECT_EQ(
        refusal(path, "",
                {{"/bin/sh", "-c", "head -c 4 <&3 >/dev/null; printf '\\377\\377\\377\\377abc' >&3", "sh"}, 60, 60}),
        path + ": its process was sent or sent more than fits a message while it was loaded");
}

/// Whatever becomes of a process, its robot stops with one fault, and the others go on as they would without it.
TEST_F(Isolation, OnlyTheRobotOfADeadPluginStops) {
    const struct {
        const char* what;
        double limit;
        const char* cause;
    } cases[] = {{"crash", 60, "ended by signal 11 (Segmentation fault)"},
                 {"overflow", 60, "ended by signal 11 (Segmentation fault)"},
                 {"abort", 60, "ended by signal 6 (Aborted)"},
                 {"exit", 60, "ended with status 0"},
                 {"quick exit", 60, "ended with status 3"},
                 {"loop", 0.3, "took longer than 0.3 s"},
                 {"huge answer", 60, "ended with status 0"}};
    for (const auto& [what, limit, cause] : cases) {
        const Scenario scenario =
            drivenBy({isolated("well_behaved", ""), isolated("misbehaving", how(what, 0.5), limit),
                      isolated("well_behaved", "speed_mps = 0.1\n")});
        WorldState state = scenario.initialState();
        const auto faults = faultsOfRun(scenario, state, 100);
        ASSERT_EQ(faults.size(), 1u) << what;
        EXPECT_EQ(faults[0].robot, 1u);
        EXPECT_EQ(faults[0].what, "its plug-in " + testPlugin("misbehaving") + ' ' + cause);
        EXPECT_EQ(scenario.commandsOf(state, 1).at(state.tick * 20'000'000), Command{});
        EXPECT_EQ(state.robots[1].velocity_B, Twist{});
        EXPECT_GT(state.robots[0].velocity_B.x, 0.2);
        EXPECT_GT(state.robots[2].velocity_B.x, 0.05);
    }
}

/// Going back to before the end starts the process anew: the same ticks follow, to the same end.
TEST_F(Isolation, RewindingBeforeTheEndIsExact) {
    const Scenario scenario = drivenBy({isolated("misbehaving", how("crash", 0.5)), isolated("well_behaved", "")});
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    std::vector<WorldState> history{state};
    for (int i = 0; i < 60; ++i) {
        step(scenario, state, buffers, {}, &trace);
        history.push_back(state);
    }
    WorldState again = history[10];
    int faults = 0;
    for (int i = 10; i < 60; ++i) {
        step(scenario, again, buffers, {}, &trace);
        faults += static_cast<int>(trace.faults.size());
        const auto difference = firstDifference(again, history[static_cast<std::size_t>(i) + 1]);
        ASSERT_FALSE(difference) << difference->message();
    }
    EXPECT_EQ(faults, 1);
}

/// What it hung at is not asked again, with the same end: its process, begun anew for the ticks before, lives on.
TEST_F(Isolation, FailureIsKnownWhenItIsAskedAgain) {
    const auto processes = [] { return ::waitpid(-1, nullptr, WNOHANG) == 0; };
    const Scenario scenario = drivenBy({isolated("misbehaving", how("loop", 0.5), 0.3)});
    WorldState first = scenario.initialState(), again = first;
    const auto faults = faultsOfRun(scenario, first, 50);
    ASSERT_EQ(faults.size(), 1u);
    EXPECT_FALSE(processes());
    const auto repeated = faultsOfRun(scenario, again, 50);
    ASSERT_EQ(repeated.size(), 1u);
    EXPECT_EQ(repeated[0].what, faults[0].what);
    EXPECT_TRUE(processes());
    EXPECT_FALSE(firstDifference(first, again));
}

/// In the program, too, a robot whose process ended in the state's past stands.
TEST_F(Isolation, EndIsPartOfTheState) {
    const Scenario apart = drivenBy({isolated("misbehaving", how("exit", 0.5))});
    WorldState state = apart.initialState();
    faultsOfRun(apart, state, 50);
    const Scenario together = drivenBy({loaded("misbehaving", how("", 0))});
    EXPECT_TRUE(faultsOfRun(together, state, 50).empty());
    EXPECT_EQ(state.robots[0].velocity_B, Twist{});
}

TEST_F(Isolation, LongObservationsGoThrough) {
    const auto controller = isolated("well_behaved", "");
    std::vector<std::byte> memory(controller->memorySize());
    controller->start(memory);
    ObservationParts observation;
    observation.robots.resize(100'000, {1, {0.5, 0}, 0});
    Decision decision;
    controller->decide(observation, memory, decision);
    ASSERT_EQ(decision.fault, "");
    EXPECT_NEAR(decision.command->w, 0.005, 1e-12);
    observation.robots.resize(1'000'000);
    decision.clear();
    controller->decide(observation, memory, decision);
    EXPECT_NE(decision.fault.find("more than fits a message"), std::string::npos) << decision.fault;
}

}  // namespace
}  // namespace mrose
