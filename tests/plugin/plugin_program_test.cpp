// What the program does with plug-ins, and with those that misbehave.
#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "cli/workshop.h"
#include "io/file.h"
#include "plugin/test_plugins.h"
#include "recording/recording.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

class PluginProgram : public testing::Test {
protected:
    /// A scenario in which one robot is driven by the misbehaving plug-in, the other by the well-behaved one.
    std::string scenario(const std::string& options) {
        return folder_
            .write("game.toml",
                   "format = \"mrose scenario\"\nversion = 1\nname = \"game\"\nenvironment = \"midsize_2001.toml\"\n"
                   "duration_s = 4.0\n" +
                       robot("bad", -2, "misbehaving", options) + robot("good", 2, "well_behaved", "speed_mps = 0.1"))
            .string();
    }
    static std::string robot(const std::string& name, double x, const std::string& plugin, const std::string& options) {
        return "[[robot]]\nname = \"" + name + "\"\ntype = \"pioneer1.toml\"\nstart = { x_m = " + std::to_string(x) +
               ", y_m = 0.0, heading_deg = 0 }\n[robot.controller]\nkind = \"plugin\"\nlibrary = \"" +
               testPlugin(plugin) + "\"\n[robot.controller.options]\n" + options + '\n';
    }
    ProgramResult run(const std::string& options, std::vector<std::string> more = {}) {
        std::vector<std::string> words{"run", scenario(options), "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return runMrose(words);
    }
    std::string recording() const { return (folder_.path() / "game.mcap").string(); }

    TemporaryFolder folder_;
    const std::string who_ = "robot \"bad\": its plug-in " + testPlugin("misbehaving");
};

TEST_F(PluginProgram, RunsThem) {
    const ProgramResult result = run("how = \"\"");
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out.find("fault"), std::string::npos) << result.out;
}

TEST_F(PluginProgram, WhatIsWrongWithOptionsHasItsPlace) {
    expectOneLine(run("how = 7"), {"game.toml:14:7: robot[\"bad\"].controller.options.how: expected a text in quotes"});
    expectOneLine(run("how = \"\"\nmood = \"bad\""),
                  {"game.toml:15:8: robot[\"bad\"].controller.options.mood: is not a known key"});
    expectOneLine(run("how = \"\"\nmood = \"bad\"", {"--isolate"}),
                  {"game.toml:15:8: robot[\"bad\"].controller.options.mood: is not a known key"});
    for (const char* where : {"--quiet", "--isolate"})
        expectOneLine(run("how = \"construction\"", {where}),
                      {"game.toml:12:11: robot[\"bad\"].controller.library: " + testPlugin("misbehaving") +
                       ": its construction threw: no map?here"});
}

TEST_F(PluginProgram, ThrowingEndsTheRunOnlyByChoice) {
    const ProgramResult goesOn = run("how = \"throw\"\nafter_s = 1.0");
    EXPECT_EQ(goesOn.status, 0) << goesOn.err;
    EXPECT_NE(goesOn.out.find("4.00 s"), std::string::npos) << goesOn.out;
    EXPECT_NE(goesOn.out.find(testPlugin("misbehaving") + " threw: index 7"), std::string::npos) << goesOn.out;
    const ProgramResult ends = run("how = \"throw\"\nafter_s = 1.0", {"--end-on-fault"});
    EXPECT_EQ(ends.status, 1);
    EXPECT_NE(ends.out.find("ended by a fault"), std::string::npos) << ends.out;
}

/// One line says who, what and when; the recording has the run up to there.
TEST_F(PluginProgram, CrashEndsTheRunAndKeepsTheRecording) {
    const struct {
        const char* what;
        const char* said;
    } cases[] = {{"crash", " crashed at tick 150 (segmentation fault)"},
                 {"overflow", " crashed at tick 150 (segmentation fault)"},
                 {"abort", " crashed at tick 150 (aborted)"},
                 {"exit", " ended the program at tick 150"}};
    for (const auto& [what, said] : cases) {
        const ProgramResult result = run(how(what, 3), {"--record", recording(), "--overwrite"});
        EXPECT_EQ(result.status, 1) << what << result.out;
        EXPECT_EQ(result.err, "mrose: " + who_ + said + '\n');
        EXPECT_EQ(result.out, "");
        const auto opened = openRecording(recording());
        ASSERT_TRUE(opened) << what;
        EXPECT_EQ(opened->branches.front().timeline.last(), 150) << what;
    }
}

/// What takes its time and returns is not taken for stuck, however often it does.
TEST_F(PluginProgram, SlowOneIsNoStuckOne) {
    const ProgramResult result = run(how("slow"), {"--plugin-limit", "0.5", "--duration", "2"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    const ProgramResult loading =
        run(how("slow loading"), {"--isolate", "--plugin-limit", "0.5", "--duration", "0.02"});
    EXPECT_EQ(loading.status, 0);
    EXPECT_EQ(loading.err, "");
}

/// A signal that is none of a plug-in's does what it would without.
TEST_F(PluginProgram, SignalOutsideOfAPluginIsNotItsFault) {
    RunningProgram program(
        {mroseProgram(), "run", scenario("how = \"\""), "--speed", "0.01", "--record", recording(), "--quiet"});
    // The recording's beginning is written after the plug-ins are loaded, and hardly any time is spent in them.
    while (!std::filesystem::exists(recording()) || std::filesystem::file_size(recording()) == 0) ::usleep(1000);
    program.send(SIGSEGV);
    const ProgramResult result = program.finish();
    EXPECT_EQ(result.status, 128 + SIGSEGV);
    EXPECT_EQ(result.err, "");
}

/// What an isolated one prints does not get between the program's results.
TEST_F(PluginProgram, PrintedTextGoesToTheErrors) {
    const ProgramResult result = run(how("print"), {"--isolate", "--json"});
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out.find("what it prints"), std::string::npos) << result.out;
    EXPECT_NE(result.err.find("what it prints"), std::string::npos);
}

/// The same.
TEST_F(PluginProgram, NeverReturningEndsTheRunAndKeepsTheRecording) {
    const ProgramResult result = run(how("loop", 3), {"--record", recording(), "--plugin-limit", "1"});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "mrose: " + who_ + " does not return at tick 150\n");
    const auto opened = openRecording(recording());
    ASSERT_TRUE(opened) << opened.error().message();
    EXPECT_EQ(opened->branches.front().timeline.last(), 150);
}

TEST_F(PluginProgram, TroubleWhileLoadingIsNamed) {
    const std::string who = "mrose: plug-in " + testPlugin("misbehaving");
    EXPECT_EQ(run(how("crash while loading")).err, who + " crashed while it was loaded (segmentation fault)\n");
    EXPECT_EQ(run(how("crash when asked for commands")).err,
              "mrose: " + who_ + " crashed while it was loaded (segmentation fault)\n");
    const ProgramResult loop = run(how("loop while loading"), {"--plugin-limit", "0.3"});
    EXPECT_EQ(loop.status, 1);
    EXPECT_EQ(loop.err, who + " does not return while it was loaded\n");
}

TEST_F(PluginProgram, BatchIsTheSameIsolated) {
    std::array<std::string, 2> results;
    for (const bool isolate : {false, true}) {
        const std::string out = (folder_.path() / (isolate ? "apart" : "together")).string();
        std::vector<std::string> words{
            "batch", scenario("how = \"\""), "--trials", "6", "--threads", "4", "--quiet", "-o", out};
        if (isolate) words.push_back("--isolate");
        const ProgramResult result = runMrose(words);
        EXPECT_EQ(result.status, 0) << result.err;
        std::string& rows = results[isolate] = readFile(out + "/results.csv").value_or("");
        // But for the commands, which say how the plug-ins were run.
        for (const std::string flag = " --isolate"; rows.find(flag) != std::string::npos;)
            rows.erase(rows.find(flag), flag.size());
    }
    EXPECT_EQ(std::count(results[0].begin(), results[0].end(), '\n'), 7) << results[0];
    EXPECT_EQ(results[0], results[1]);
}

TEST_F(PluginProgram, BatchIsWatchedOnEveryThread) {
    const ProgramResult result = runMrose({"batch", scenario(how("crash", 3)), "--trials", "8", "--threads", "4",
                                           "--quiet", "-o", (folder_.path() / "out").string()});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err.substr(0, result.err.find('\n')),
              "mrose: " + who_ + " crashed at tick 150 (segmentation fault)");
}

TEST_F(PluginProgram, IsolatedOneStopsAloneAndItsStopIsRecorded) {
    const struct {
        const char* what;
        const char* said;
    } cases[] = {{"crash", " ended by signal 11 (Segmentation fault)"}, {"loop", " took longer than 1 s"}};
    for (const auto& [what, said] : cases) {
        const ProgramResult result =
            run(how(what, 3), {"--isolate", "--plugin-limit", "1", "--record", recording(), "--overwrite"});
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.err, "");
        EXPECT_NE(result.out.find("4.00 s"), std::string::npos) << result.out;
        EXPECT_NE(result.out.find("faults: 1, "), std::string::npos) << result.out;
        EXPECT_NE(result.out.find(testPlugin("misbehaving") + said), std::string::npos) << result.out;
        const ProgramResult replayed = runMrose({"replay", recording(), "--quiet"});
        EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
    }
}

/// A replay that asks a plug-in again watches it, too.
TEST_F(PluginProgram, CrashInAReplayIsNamed) {
    run(how("crash", 3), {"--isolate", "--record", recording()});
    const ProgramResult replayed = runMrose({"replay", recording(), "--decide", "--quiet"});
    EXPECT_EQ(replayed.status, 1);
    EXPECT_EQ(replayed.err, "mrose: " + who_ + " crashed at tick 150 (segmentation fault)\n");
}

/// Decided again in this program what was decided in processes of its own.
TEST_F(PluginProgram, IsolationMakesNoDifference) {
    const ProgramResult result = run("how = \"\"", {"--isolate", "--record", recording()});
    EXPECT_EQ(result.status, 0) << result.err;
    for (const bool isolate : {false, true}) {
        std::vector<std::string> words{"replay", recording(), "--decide", "--quiet"};
        if (isolate) words.push_back("--isolate");
        const ProgramResult replayed = runMrose(words);
        EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
        EXPECT_NE(replayed.out.find("200 ticks replayed, the controllers deciding again"), std::string::npos)
            << replayed.out;
    }
}

TEST_F(PluginProgram, CheckRewindNamesTheOneThatHides) {
    const ProgramResult hidden = run(how("hidden command", 1), {"--check-rewind"});
    EXPECT_EQ(hidden.status, 1);
    EXPECT_TRUE(
        hidden.err.starts_with("mrose: tick 50 cannot be taken back: robot \"bad\": its controller decided "
                               "otherwise when it was asked again: v 0.3, w "))
        << hidden.err;
    EXPECT_EQ(std::count(hidden.err.begin(), hidden.err.end(), '\n'), 1);
    const ProgramResult honest = run("how = \"\"", {"--check-rewind"});
    EXPECT_EQ(honest.status, 0) << honest.err;
    const ProgramResult plain = run("how = \"\"");
    const std::string state = "state ";
    const auto hash = [&](const std::string& out) { return out.substr(out.find(state), 22); };
    EXPECT_EQ(hash(honest.out), hash(plain.out));
}

}  // namespace
}  // namespace mrose
