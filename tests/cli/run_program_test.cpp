// `mrose run` as its users run it.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>

#include "io/file.h"
#include "recording/recording.h"
#include "scenario/scenario_file.h"
#include "scenario/state_scenario.h"
#include "simulation/step.h"
#include "support/game_folder.h"
#include "support/places.h"

namespace mrose {
namespace {

using Json = nlohmann::json;
using RunProgram = GameFolder;

TEST_F(RunProgram, TellsWhatHappened) {
    const ProgramResult result = play("run", {});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(result.out.starts_with("a game, seed 5: 3.00 s\n")) << result.out;
    for (const char* part : {"goals: 0 in yellow, 0 in blue\n", "robot 1 (one's)", "robot 2 (two)", "\nstate "})
        EXPECT_NE(result.out.find(part), std::string::npos) << result.out << part;
    const Json json = told(play("run", {"--json"}));
    EXPECT_EQ(json["scenario"], "a game");
    EXPECT_EQ(json["trial"], 0);
    EXPECT_EQ(json["seed"], 5);
    EXPECT_EQ(json["end"], "duration");
    EXPECT_EQ(json["time_s"], 3);
    EXPECT_EQ(json["faults"], 0);
    EXPECT_EQ(json["goals"]["blue"], 0);
    EXPECT_GT(json["driven_m"]["one's"], 0.3);
    EXPECT_NE(result.out.find("state " + json["world_hash"].get<std::string>()), std::string::npos);
    EXPECT_FALSE(json.contains("recording"));
}

TEST_F(RunProgram, SeedTrialAndDurationDecideTheRun) {
    const auto hash = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"--json"};
        words.insert(words.end(), more.begin(), more.end());
        return told(play("run", words))["world_hash"].get<std::string>();
    };
    const std::string plain = hash({});
    EXPECT_EQ(hash({}), plain);
    EXPECT_EQ(hash({"--seed", "5", "--duration", "3"}), plain);
    expectOneLine(play("run", {"--trial", "0"}), {"--trial: 0 is below 1"}, 2);
    EXPECT_EQ(hash({"--check-rewind"}), plain);
    EXPECT_EQ(hash({"--isolate"}), plain) << "there is no plug-in";
    EXPECT_NE(hash({"--seed", "6"}), plain);
    EXPECT_NE(hash({"--trial", "1"}), plain);
    EXPECT_NE(hash({"--trial", "2"}), hash({"--trial", "1"}));
    EXPECT_NE(hash({"--duration", "2.98"}), plain);
    // Paced by the clock, and recorded.
    EXPECT_EQ(hash({"--speed", "20"}), plain);
    EXPECT_EQ(hash({"--record", path("game.mcap")}), plain);
    EXPECT_NE(play("run", {"--trial", "4"}).out.find("a game, trial 4, seed 5: "), std::string::npos);
}

TEST_F(RunProgram, AnythingOfTheScenarioMayBeOverridden) {
    const auto hash = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"--json"};
        words.insert(words.end(), more.begin(), more.end());
        return told(play("run", words))["world_hash"].get<std::string>();
    };
    EXPECT_EQ(hash({"--set", "seed=6"}), hash({"--seed", "6"}));
    EXPECT_EQ(hash({"--set", "seed = 5"}), hash({}));
    EXPECT_NE(hash({"--set", "robot[\"two\"].start.heading_deg=45"}), hash({}));
    // A file is seen from the current folder.
    const std::string network = (sourceFolder() / "nets/pioneer.net").string();
    write("mine.net", *readFile(network));
    const std::string set = "robot[1].network=";
    const ProgramResult here = RunningProgram({"/usr/bin/env", "-C", path("."), mroseProgram(), "run", game(), "--json",
                                               "--quiet", "--set", set + "mine.net"})
                                   .finish();
    EXPECT_EQ(told(here)["world_hash"], hash({"--set", set + network}));
    // Rows of a batch run alone as they did, and so do trials of what its folder keeps.
    ASSERT_EQ(play("batch", {"--trials", "2", "--set", "seed=6", "-o", path("games")}).status, 0);
    const auto rows = csvRows(*readFile(path("games/results.csv")));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_NE(rows[1].at("command").find(" --set seed=6 "), std::string::npos) << rows[1].at("command");
    EXPECT_EQ(told(runMrose({"run", path("games/scenario.value"), "--trial", "2", "--json", "--quiet"}))["world_hash"],
              hash({"--seed", "6", "--trial", "2"}));
    expectOneLine(play("run", {"--set", "robot[9].network=x"}), {"robot[9].network: names nothing that there is"});
    expectOneLine(play("run", {"--set", "seed"}), {"seed: expected PATH=VALUE"});
    expectOneLine(play("run", {"--set", "robot[2].network=none.net"}), {"\"none.net\" was not found"});
}

TEST_F(RunProgram, TrialOfAnExperimentSaysWhatItMeasured) {
    const std::vector<std::string> words{"run",   "faster_turns.toml", "--trial",
                                         "10003", "--variant",         "faster in reality"};
    std::vector<std::string> asJson = words;
    asJson.insert(asJson.end(), {"--json", "--quiet"});
    const Json json = told(runMrose(asJson));
    EXPECT_EQ(json["trial"], 10003);
    EXPECT_EQ(json["variant"], "faster in reality");
    const double time = json["measure.time_s"];
    EXPECT_NEAR(time, json["time_s"].get<double>(), 1e-9) << "it ends where it is measured";
    const std::string text = runMrose(words).out;
    EXPECT_NE(text.find("measure.time_s"), std::string::npos) << text;
}

TEST_F(RunProgram, WhatAnExperimentSetsItselfIsNotOverridden) {
    write("x.toml",
          "format = \"mrose experiment\"\nversion = 1\nname = \"x\"\nscenario = \"" + game() +
              "\"\ntrials = 1\n"
              "duration_s = 0.5\n[[draw]]\nname = \"x\"\npath = 'robot[\"two\"].start.x_m'\nfrom = 0.5\nto = 0.6\n"
              "[[variant]]\nname = \"one way\"\nset = { \"robot[2].start.heading_deg\" = 10, "
              "\"robot[1].start.heading_deg\" = 10 }\n"
              "[[variant]]\nname = \"another\"\nset = { \"robot[2].start.heading_deg\" = 20 }\n");
    const auto set = [&](const std::string& assignment, const std::string& variant = "one way") {
        return runMrose({"run", path("x.toml"), "--quiet", "--variant", variant, "--set", assignment});
    };
    expectOneLine(set("robot[2].start.x_m=1"),
                  {"--set robot[2].start.x_m: has no effect: draw \"x\" sets it in each trial"});
    expectOneLine(set("robot[\"two\"].start.heading_deg=1"), {"each variant sets it"});
    expectOneLine(set("seed=1"), {"each run has a seed of its own"});
    for (const std::string assignment : {"robot[1].start.heading_deg=1", "robot[*].start.heading_deg=1"}) {
        expectOneLine(set(assignment), {"has no effect: variant \"one way\" sets it"});
        EXPECT_EQ(set(assignment, "another").status, 0) << "that leaves the first robot as it is";
    }
}

TEST_F(RunProgram, ConditionEndsIt) {
    EXPECT_THAT(play("run", {"--until", "time > 99", "--duration", "1"}).out,
                testing::HasSubstr(": 1.00 s, in which the condition was never met"));
    const Json json = told(play("run", {"--json", "--until", "robot[\"one's\"].speed > 0.2 and time > 1.5"}));
    EXPECT_EQ(json["end"], "condition");
    EXPECT_GE(json["time_s"], 1.52);
    EXPECT_LT(json["time_s"], 3);
    const ProgramResult never = play("run", {"--until", "time > 5"});
    EXPECT_EQ(never.status, 0);
    EXPECT_EQ(never.out.find("ended by"), std::string::npos) << never.out;
}

TEST_F(RunProgram, WhatItReadsIsNotOverwritten) {
    game();
    const std::string scenario = path("it's a game.toml"), before = readFile(scenario).value_or("");
    expectOneLine(play("run", {"--record", scenario, "--overwrite"}), {scenario + ": is read by this command"});
    EXPECT_EQ(readFile(scenario).value_or(""), before);
}

TEST_F(RunProgram, WrongConditionsAreOneLineAndNothingIsWritten) {
    game();
    const auto before = listing();
    for (const auto& [condition, part] :
         {std::pair{"robot[2].speed >", "--until:1:"}, std::pair{"robot[3].x > 0", "there is no robot 3"},
          std::pair{"ball.sped > 1", "sped"}, std::pair{"ball.x", "--until"},
          std::pair{"time > 1; os.exit()", "--until"},
          std::pair{"(function() while true do end end)()", "instructions"}}) {
        const std::string recording = path("game.mcap");
        expectOneLine(play("run", {"--until", condition, "--record", recording}), {part});
        EXPECT_EQ(listing(), before) << condition;
    }
}

/// It can be answered at the start, but not later; what was recorded until then is there.
TEST_F(RunProgram, ConditionThatLoopsForEverLaterEndsItAndKeepsTheRecording) {
    const std::string endless = "(function() while time > 2 do end return false end)()";
    expectOneLine(play("run", {"--until", endless, "--record", path("game.mcap")}), {"--until: ", "instructions"});
    const auto recording = openRecording(path("game.mcap"));
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->damage.empty());
    EXPECT_EQ(recording->branches[0].timeline.last(), 101);
}

TEST_F(RunProgram, WrongFlagsAreOneLine) {
    game();
    const auto before = listing();
    const std::pair<std::vector<std::string>, std::string> cases[] = {{{"--duration", "0"}, "--duration"},
                                                                      {{"--duration", "-3"}, "--duration"},
                                                                      {{"--duration", "nan"}, "--duration"},
                                                                      {{"--duration", "1e8"}, "--duration"},
                                                                      {{"--speed", "-1"}, "--speed"},
                                                                      {{"--speed", "nan"}, "--speed"},
                                                                      {{"--speed", "fast"}, "--speed"},
                                                                      {{"--seed", "-1"}, "--seed"},
                                                                      {{"--seed", "18446744073709551616"}, "--seed"},
                                                                      {{"--record", ""}, "--record"},
                                                                      {{"--trial", "-1"}, "--trial"},
                                                                      {{"--trial", "one"}, "--trial"},
                                                                      {{"--plugin-limit", "0"}, "--plugin-"},
                                                                      {{"--trials", "7"}, "--trials"},
                                                                      {{"--until"}, "--until"},
                                                                      {{"--until", ""}, "--until"},
                                                                      {{"more"}, "more"}};
    for (const auto& [words, part] : cases) expectOneLine(play("run", words), {part}, 2);
    expectOneLine(runMrose({"run"}), {"SCENARIO", "required"}, 2);
    expectOneLine(runMrose({"run", path("none.toml")}), {"none.toml: does not exist"});
    expectOneLine(runMrose({"run", game(), "--log", path("none"), "--until", "x"}), {"--until"});
    expectOneLine(play("run", {"--record", path("no/such/game.mcap")}), {"no/such/game.mcap: ", "No such file"});
    EXPECT_EQ(listing(), before);
}

TEST_F(RunProgram, RecordingsAreNotReplacedUnlessAsked) {
    write("game.mcap", "earlier");
    expectOneLine(play("run", {"--record", path("game.mcap")}), {"game.mcap: is there already"});
    EXPECT_EQ(read("game.mcap"), "earlier");
    const Json json = told(play("run", {"--record", path("game.mcap"), "--overwrite", "--json"}));
    EXPECT_EQ(json["recording"], path("game.mcap"));
    const ProgramResult replayed = runMrose({"replay", path("game.mcap"), "--quiet"});
    EXPECT_EQ(replayed.status, 0) << replayed.out << replayed.err;
    EXPECT_NE(replayed.out.find("150 ticks replayed"), std::string::npos) << replayed.out;
}

/// From no room at all to room for nearly all of it.
TEST_F(RunProgram, FullDiskIsOneLineAndTheRunGoesOn) {
    const std::string file = path("game.mcap");
    const std::string hash = told(play("run", {"--record", file, "--json"}))["world_hash"];
    const std::uint64_t whole = std::filesystem::file_size(file);
    std::filesystem::remove(file);
    const auto before = listing();
    expectOneLine(play("run", {"--record", file}, {.fullDisk = true}),
                  {"game.mcap: cannot be written: File too large"});
    EXPECT_EQ(listing(), before) << "nothing half-written is left";
    for (const std::uint64_t room : {whole - 1, whole - 500}) {
        const ProgramResult result = play("run", {"--record", file, "--overwrite"}, {.fullDisk = true, .room = room});
        expectOneLine(result, {"game.mcap: cannot be written: File too large"});
        EXPECT_NE(result.out.find("state " + hash), std::string::npos) << result.out;
        EXPECT_EQ(result.out.find("recorded in"), std::string::npos) << result.out;
        const auto recording = openRecording(file);
        ASSERT_TRUE(recording) << recording.error().message();
        EXPECT_EQ(recording->damage.size(), 1u);
    }
    // Long before the end: it says so at once.
    const ProgramResult early =
        play("run", {"--record", file, "--overwrite", "--duration", "60"}, {.fullDisk = true, .room = whole});
    expectOneLine(early,
                  {"game.mcap: cannot be written: File too large; the run goes on, and its recording ends here"});
    EXPECT_NE(early.out.find(": 60.00 s"), std::string::npos) << early.out;
}

TEST_F(RunProgram, CutRecordingIsNamedWithWhatIsKept) {
    told(play("run", {"--record", path("game.mcap"), "--duration", "30", "--json"}));
    const std::string whole = read("game.mcap");
    write("cut.mcap", whole.substr(0, whole.size() * 2 / 3));
    const auto recording = openRecording(path("cut.mcap"));
    ASSERT_TRUE(recording) << recording.error().message();
    const std::int64_t ticks = recording->branches[0].timeline.last();
    ASSERT_GT(ticks, 0);
    char kept[60];
    std::snprintf(kept, sizeof kept, "; kept: %d ticks, %g", static_cast<int>(ticks),
                  0.02 * static_cast<double>(ticks));
    expectOneLine(runMrose({"replay", path("cut.mcap")}), {path("cut.mcap") + ": it is cut off at byte ", kept}, 0);
    expectOneLine(play("run", {"--record", "/"}), {"/: is no regular file"});
}

TEST_F(RunProgram, SaysWhoStartsOutsideTheWalls) {
    const std::string text = (game(), read("it's a game.toml"));
    const std::string far = write("far.toml", replaced(text, "x_m = 1.0, y_m = 1.0", "x_m = 1.0, y_m = 9.5"));
    const std::string note =
        "mrose: note: \"two\" starts at (1.0, 9.5), outside of what the environment's walls and floor "
        "area span\n";
    EXPECT_EQ(runMrose({"run", far, "--duration", "0.1"}).err, note);
    EXPECT_EQ(runMrose({"shapes", far}).err, note);
    EXPECT_EQ(runMrose({"run", path("it's a game.toml"), "--duration", "0.1"}).err, "");
}

TEST_F(RunProgram, SaysOnceWhoseNetworkKnowsNoNoise) {
    write("paper.toml",
          "format = \"mrose robot\"\nversion = 1\nname = \"As in the paper\"\nshape = \"create.toml\"\n"
          "mass_kg = 4.5\ncontrol_period_s = 0.1\n[motion]\nnetwork = \"create_paper.net\"\n");
    std::string text = (game(), read("it's a game.toml"));
    text = replaced(replaced(text, "pioneer1.toml", "paper.toml"), "nomad200.toml", "paper.toml");
    const std::string two =
        write("two.toml", replaced(text, "kind = \"chase_ball\", target_m = [4.8, 0.0]", "kind = \"wander\""));
    const std::string note =
        "mrose: note: the network of robots of type \"As in the paper\" knows its mean alone: they drive the same way "
        "every time, which real ones do not\n";
    EXPECT_EQ(runMrose({"run", two, "--duration", "0.1"}).err, note);
    EXPECT_EQ(runMrose({"batch", two, "--trials", "2", "--duration", "0.1", "-q", "-o", path("out")}).err, note);
    const std::string yard = write("yard.toml", replaced(read("it's a game.toml"), "nomad200.toml", "husky.toml"));
    EXPECT_EQ(runMrose({"run", yard, "--duration", "0.1"}).err, "") << "ships with its noise";
}

TEST_F(RunProgram, KicksAreToldWhereThereAreKickers) {
    EXPECT_NE(play("run", {"--duration", "0.1"}).out.find("; kicks: 0, 0 of them on a ball\n"), std::string::npos);
    const ProgramResult corridor = runMrose({"run", "b21_corridor.toml", "--duration", "0.1"});
    EXPECT_EQ(corridor.out.find("kick"), std::string::npos) << corridor.out;
    EXPECT_NE(corridor.out.find("touches: "), std::string::npos) << corridor.out;
}

class LongRun : public GameFolder {
protected:
    /// A run of days that is recorded, when it has shown how far it is.
    std::unique_ptr<RunningProgram> underWay() {
        auto program = std::make_unique<RunningProgram>(std::vector<std::string>{
            mroseProgram(), "run", game(), "--duration", "1000000", "--record", path("game.mcap")});
        EXPECT_TRUE(program->waitForError(" of 1000000.0 s, "));
        return program;
    }
};

TEST_F(LongRun, InterruptClosesTheRecording) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        std::filesystem::remove(path("game.mcap"));
        const auto program = underWay();
        program->send(signal);
        const ProgramResult result = program->finish();
        EXPECT_EQ(result.status, 128 + signal) << result.err;
        EXPECT_NE(result.out.find(" s, interrupted"), std::string::npos) << result.out;
        EXPECT_NE(result.out.find("recorded in " + path("game.mcap")), std::string::npos) << result.out;
        const auto recording = openRecording(path("game.mcap"));
        ASSERT_TRUE(recording) << recording.error().message();
        EXPECT_TRUE(recording->damage.empty());
        const double seconds = static_cast<double>(recording->branches[0].timeline.last()) * 0.02;
        char text[60];
        std::snprintf(text, sizeof text, "a game, seed 5: %.2f s, interrupted", seconds);
        EXPECT_TRUE(result.out.starts_with(text)) << result.out << text;
    }
}

/// Its ticks are minutes apart.
TEST_F(LongRun, SlowRunIsInterruptedAtOnce) {
    using Clock = std::chrono::steady_clock;
    RunningProgram program(
        {mroseProgram(), "run", game(), "--speed", "0.0001", "--record", path("game.mcap"), "--quiet"});
    while (!std::filesystem::exists(path("game.mcap"))) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const Clock::time_point sent = Clock::now();
    program.send(SIGTERM);
    EXPECT_EQ(program.finish().status, 128 + SIGTERM);
    EXPECT_LT(Clock::now() - sent, std::chrono::seconds(100));
    EXPECT_TRUE(openRecording(path("game.mcap"))->damage.empty());
}

/// Of two on one recording the second is refused, and harms nothing.
TEST_F(LongRun, RecordingHasOneWriter) {
    const auto program = underWay();
    for (const std::vector<std::string>& more : {std::vector<std::string>{"--overwrite"}, {}})
        for (const std::string name : {"game.mcap", "link.mcap"}) {
            std::vector<std::string> words{"--record", path(name)};
            if (name != "game.mcap" && !std::filesystem::exists(path(name)))
                std::filesystem::create_symlink("game.mcap", path(name));
            words.insert(words.end(), more.begin(), more.end());
            const ProgramResult second = play("run", words);
            expectOneLine(second, {path(name) + (more.empty() ? ": is there already" : ": is being written by a ru")});
            EXPECT_EQ(second.out, "");
        }
    program->send(SIGINT);
    const ProgramResult first = program->finish();
    EXPECT_EQ(first.err.find("game.mcap"), std::string::npos) << first.err;
    EXPECT_NE(first.out.find("recorded in "), std::string::npos) << first.out;
    EXPECT_EQ(runMrose({"replay", path("game.mcap"), "--quiet"}).status, 0);
}

TEST_F(LongRun, KilledProcessBlocksNoOther) {
    const auto program = underWay();
    program->send(SIGKILL);
    program->finish();
    const Json json = told(play("run", {"--record", path("game.mcap"), "--overwrite", "--json"}));
    EXPECT_EQ(json["recording"], path("game.mcap"));
    EXPECT_TRUE(openRecording(path("game.mcap"))->damage.empty());
}

TEST_F(LongRun, KillLeavesARecordingThatReplays) {
    const auto program = underWay();
    program->send(SIGKILL);
    EXPECT_EQ(program->finish().status, 128 + SIGKILL);
    const auto recording = openRecording(path("game.mcap"));
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_EQ(recording->damage.size(), 1u);
    EXPECT_GT(recording->branches[0].timeline.last(), 0);
}

/// Ticks are counted on, so that the noise goes on too.
TEST_F(RunProgram, ScenarioOfASavedStateEndsAsTheRunItIsOf) {
    DiskDescriptions source({sourceFolder(), {}, ""});
    auto loaded = loadScenario(game(), source);
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Scenario scenario(loaded->parts);
    WorldState state = scenario.initialState();
    while (state.tick < 50) state = stepped(scenario, std::move(state));
    std::filesystem::create_directories(path("other"));
    const auto saved = saveStateAsScenario(path("other/later.toml"), loaded->value, scenario, state, source);
    ASSERT_TRUE(saved) << saved.error().message();
    const nlohmann::json whole = told(play("run", {"--duration", "3", "--json"}));
    const nlohmann::json later =
        told(runMrose({"run", path("other/later.toml"), "--duration", "2", "--json", "--quiet"}));
    EXPECT_EQ(later["world_hash"], whole["world_hash"]);
    EXPECT_EQ(later["time_s"], 3.0);
    EXPECT_EQ(told(runMrose(
                  {"run", path("other/later.toml"), "--duration", "2", "--trial", "1", "--json", "--quiet"}))["time_s"],
              3.0);
    // The state file holds the scenario, too.
    std::filesystem::rename(path("other/later.state"), path("alone.state"));
    EXPECT_EQ(told(runMrose({"run", path("alone.state"), "--duration", "2", "--json", "--quiet"}))["world_hash"],
              whole["world_hash"]);
    std::filesystem::rename(path("alone.state"), path("other/later.state"));
    // A batch is not taken up where the state has become another.
    const std::vector<std::string> batch{"batch", path("other/later.toml"), "--duration", "0.1", "--trials", "2",
                                         "-o",    path("results"),          "--quiet"};
    EXPECT_EQ(runMrose(batch).status, 0);
    EXPECT_EQ(runMrose(batch).status, 0);
    state = stepped(scenario, std::move(state));
    ASSERT_TRUE(saveStateAsScenario(path("other/later.toml"), loaded->value, scenario, state, source));
    const ProgramResult changed = runMrose(batch);
    EXPECT_EQ(changed.status, 1) << changed.out;
    EXPECT_NE(changed.err.find("later.state"), std::string::npos) << changed.err;
    write("other/later.state", "no state");
    expectOneLine(runMrose({"run", path("other/later.toml")}), {"later.state:1:", "TOML"});
}

}  // namespace
}  // namespace mrose
