// What the program does with plug-ins, and with those that misbehave.
#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include "io/file.h"
#include "plugin/test_plugins.h"
#include "recording/recording.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "support/workshop.h"

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

/// Whatever is thrown.
TEST_F(PluginProgram, WhatIsThrownIsToldInOneLine) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--isolate"}}) {
        const ProgramResult result = run(how("throw two lines", 1), more);
        EXPECT_EQ(result.status, 0) << result.err;
        EXPECT_NE(result.out.find(testPlugin("misbehaving") + " threw: one?two\n"), std::string::npos) << result.out;
    }
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

/// Whatever it commands, in the program and isolated; the recording has it.
TEST_F(PluginProgram, AbsurdCommandStopsItsRobotAlone) {
    const std::pair<const char*, const char*> cases[] = {
        {"huge v", " gave a command of 1e+160 m/s; expected at most 1000 m/s"},
        {"huge w", " gave a command of -1e+200 rad/s; expected at most 1000 rad/s"}};
    for (const auto& [what, said] : cases)
        for (const std::vector<std::string>& isolate : {std::vector<std::string>{}, {"--isolate"}}) {
            std::vector<std::string> more{"--record", recording(), "--overwrite"};
            more.insert(more.end(), isolate.begin(), isolate.end());
            const ProgramResult result = run(how(what, 1), more);
            EXPECT_EQ(result.status, 0) << what;
            EXPECT_EQ(result.err, "");
            EXPECT_NE(result.out.find("4.00 s"), std::string::npos) << result.out;
            EXPECT_NE(result.out.find(testPlugin("misbehaving") + said), std::string::npos) << result.out;
            const ProgramResult replayed = runMrose({"replay", recording(), "--quiet"});
            EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
        }
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
        EXPECT_EQ(result.err, "mrose: " + who_ + said + "; with --isolate only its robot stops\n");
        EXPECT_EQ(result.out, "");
        const auto opened = openRecording(recording());
        ASSERT_TRUE(opened) << what;
        EXPECT_EQ(opened->branches.front().timeline.last(), 150) << what;
    }
}

/// What it is asked for in the course of a run is not taken for its loading.
TEST_F(PluginProgram, CrashWhenAskedToExplainIsNamed) {
    EXPECT_EQ(run(how("crash when asked to explain")).err,
              "mrose: " + who_ +
                  " crashed when it was asked to explain itself (segmentation fault); with --isolate only its robot "
                  "stops\n");
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
    // The recording's beginning is written after the plug-ins are loaded; between two ticks it sleeps for 2 s.
    while (!std::filesystem::exists(recording()) || std::filesystem::file_size(recording()) == 0) ::sched_yield();
    program.waitUntilAsleep();
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
    EXPECT_EQ(result.err, "mrose: " + who_ + " does not return at tick 150; with --isolate only its robot stops\n");
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
    EXPECT_THAT(
        result.err.substr(0, result.err.find('\n')),
        testing::MatchesRegex(".*" + std::string("crashed at tick 150 of trial [1-8], seed 1 .segmentation fault.; "
                                                 "the same command with --isolate goes on with the rest")));
}

TEST_F(PluginProgram, ExitInABatchNamesTheRun) {
    const ProgramResult result = runMrose({"batch", scenario(how("exit", 3)), "--trials", "2", "--threads", "1",
                                           "--quiet", "-o", (folder_.path() / "out").string()});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err, "mrose: " + who_ +
                              " ended the program at tick 150 of trial 1, seed 1; the same command with --isolate goes "
                              "on with the rest\n");
}

/// Nothing done before is lost or done again.
TEST_F(PluginProgram, BatchThatAPluginEndedGoesOnIsolated) {
    const std::string out = (folder_.path() / "out").string();
    const auto batch = [&](const char* trials, const std::vector<std::string>& more) {
        std::vector<std::string> words{"batch", scenario(how("crash", 3)), "--trials", trials, "--quiet", "-o", out};
        words.insert(words.end(), more.begin(), more.end());
        return runMrose(words);
    };
    ASSERT_EQ(batch("2", {"--isolate"}).status, 0);
    const std::string before = readFile(out + "/results.csv").value_or("");
    const ProgramResult crashed = batch("4", {"--threads", "1"});
    EXPECT_EQ(crashed.status, 1);
    EXPECT_EQ(crashed.err, "mrose: " + who_ +
                               " crashed at tick 150 of trial 3, seed 1 (segmentation fault); the same command with "
                               "--isolate goes on with the rest\n");
    const ProgramResult whole = batch("4", {"--isolate", "--plugin-limit", "5"});
    EXPECT_EQ(whole.status, 0) << whole.err;
    EXPECT_NE(whole.out.find("4 runs in "), std::string::npos) << whole.out;
    EXPECT_NE(whole.out.find(", 2 of them done before"), std::string::npos) << whole.out;
    const std::string after = readFile(out + "/results.csv").value_or("");
    EXPECT_TRUE(after.starts_with(before)) << after;
    EXPECT_EQ(std::count(after.begin(), after.end(), '\n'), 5);
}

TEST_F(PluginProgram, PluginThatWasBuiltAgainMakesAnotherBatch) {
    const std::filesystem::path plugin = folder_.path() / "own.so";
    std::filesystem::copy_file(testPlugin("well_behaved"), plugin);
    std::string text = readFile(scenario("how = \"\"")).value_or("");
    for (const std::string of : {"misbehaving", "well_behaved"})
        text.replace(text.find(testPlugin(of)), testPlugin(of).size(), "own.so");
    text.replace(text.find("how = \"\""), 8, "");
    const std::string game = folder_.write("own.toml", text).string();
    const std::vector<std::string> words{
        "batch", game, "--trials", "2", "--duration", "1", "--quiet", "-o", (folder_.path() / "out").string()};
    EXPECT_EQ(runMrose(words).status, 0);
    EXPECT_EQ(runMrose(words).status, 0) << "the same";
    // What is behind the end of a library changes nothing but its content.
    folder_.write("own.so", *readFile(plugin) + ' ');
    const ProgramResult other = runMrose(words);
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.err.find("holds other results: the content of " + plugin.string() + " has changed; "),
              std::string::npos)
        << other.err;
}

/// Recorded with relative names in one folder, replayed in another.
TEST_F(PluginProgram, ReplayFindsThePluginFromAnyFolder) {
    std::filesystem::create_directories(folder_.path() / "plug");
    std::filesystem::create_directories(folder_.path() / "elsewhere" / "beside");
    std::filesystem::copy_file(testPlugin("well_behaved"), folder_.path() / "plug" / "own.so");
    std::string text = readFile(scenario("how = \"\"")).value_or("");
    for (const std::string of : {"misbehaving", "well_behaved"})
        text.replace(text.find(testPlugin(of)), testPlugin(of).size(), "plug/own.so");
    text.replace(text.find("how = \"\""), 8, "");
    folder_.write("own.toml", text);
    const auto in = [&](const std::string& folder, const std::string& words) {
        return RunningProgram({"/bin/sh", "-c",
                               "cd '" + (folder_.path() / folder).string() + "' && '" + mroseProgram() + "' " + words})
            .finish();
    };
    EXPECT_EQ(in("", "run own.toml --duration 1 --record a.mcap -q").status, 0);
    for (const auto& [folder, recording] :
         {std::pair{"", "a.mcap"}, std::pair{"elsewhere", "../a.mcap"}, std::pair{"plug", "../a.mcap"}}) {
        const ProgramResult replayed = in(folder, std::string("replay --decide ") + recording);
        EXPECT_EQ(replayed.status, 0) << folder << replayed.err;
    }
    std::filesystem::copy_file(folder_.path() / "a.mcap", folder_.path() / "elsewhere" / "beside" / "a.mcap");
    const ProgramResult lost = in("elsewhere", "replay --decide beside/a.mcap");
    EXPECT_EQ(lost.status, 1);
    std::string said = "the plug-in is neither ";
    for (const char* const place : {"elsewhere/plug/own.so", "elsewhere/beside/plug/own.so", "elsewhere/beside/own.so"})
        said += (said.ends_with("neither ") ? "" : ", nor ") + (folder_.path() / place).string();
    EXPECT_NE(lost.err.find(said), std::string::npos) << lost.err;
    EXPECT_EQ(std::count(lost.err.begin(), lost.err.end(), '\n'), 1);
    std::filesystem::copy_file(folder_.path() / "plug" / "own.so", folder_.path() / "elsewhere" / "beside" / "own.so");
    EXPECT_EQ(in("elsewhere", "replay --decide beside/a.mcap").status, 0);
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
    EXPECT_EQ(replayed.err,
              "mrose: " + who_ + " crashed at tick 150 (segmentation fault); with --isolate only its robot stops\n");
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
    EXPECT_NE(honest.out.find("200 ticks taken twice, each time with the same end\n"), std::string::npos) << honest.out;
    const ProgramResult plain = run("how = \"\"");
    const std::string state = "state ";
    const auto hash = [&](const std::string& out) { return out.substr(out.find(state), 22); };
    EXPECT_EQ(hash(honest.out), hash(plain.out));
}

}  // namespace
}  // namespace mrose
