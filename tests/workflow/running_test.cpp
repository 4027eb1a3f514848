// Scenarios: opened, run, recorded, replayed, tried many times.
#include <atomic>
#include <map>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "debug/breakpoint.h"
#include "io/format.h"
#include "support/game_folder.h"
#include "support/places.h"
#include "workflow/expect_error.h"
#include "workflow/open_run.h"
#include "workflow/read_trials.h"
#include "workflow/replay_recording.h"
#include "workflow/run_batch.h"
#include "workflow/run_experiment.h"
#include "workflow/run_scenario.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

class Running : public GameFolder {
protected:
    RunRequest request(double duration = 1) {
        RunRequest request{{game()}};
        request.duration = duration;
        return request;
    }
    static std::uint64_t hashAfter(const RunRequest& request) {
        const auto run = runScenario(request);
        EXPECT_TRUE(run) << run.error().message();
        return run ? hashOf(run->result.state).world : 0;
    }
    /// What repeats a row of an experiment's results.
    static RunRequest requestOf(const std::map<std::string, std::string>& row, const std::string& experiment) {
        RunRequest request{{experiment}};
        request.scenario.trial = static_cast<std::uint32_t>(std::stoul(row.at("trial")));
        request.scenario.variant = row.at("variant_name");
        request.seed = std::stoull(row.at("seed"));
        return request;
    }
};

TEST_F(Running, SeedTrialAndOverridesDecideTheRun) {
    const std::uint64_t plain = hashAfter(request());
    EXPECT_EQ(hashAfter(request()), plain);
    RunRequest other = request();
    other.seed = 6;
    const std::uint64_t seeded = hashAfter(other);
    EXPECT_NE(seeded, plain);
    other = request();
    other.scenario.overrides = {"seed=6"};
    EXPECT_EQ(hashAfter(other), seeded);
    other = request();
    other.scenario.trial = 3;
    EXPECT_NE(hashAfter(other), plain);
    other = request();
    other.checkRewind = true;
    EXPECT_EQ(hashAfter(other), plain);
}

TEST_F(Running, OverridesThatFitNothingAreNamed) {
    RunRequest wrong = request();
    wrong.scenario.overrides = {"robot[9].network=x"};
    expectError(runScenario(wrong), game(), {"robot[9].network: names nothing that there is"});
    wrong.scenario.overrides = {"seed"};
    expectError(runScenario(wrong), "seed", {"seed: expected PATH=VALUE"});
}

TEST_F(Running, WhatIsWrongWithTheScenarioHasItsPlace) {
    game();
    const std::string wrong = write("wrong.toml", read("it's a game.toml") + "colour = \"red\"\n");
    const auto run = runScenario({{wrong}});
    expectError(run, wrong, {"colour: is not a known key"});
    EXPECT_GT(run.error().line, 1);
    RunRequest condition = request();
    condition.until = "robot[7].speed > 0";
    expectError(runScenario(condition), "--until", {"robot"});
}

TEST_F(Running, NotesAreKnownBeforeItBegins) {
    game();
    RunRequest far = request(0.1);
    far.scenario.file =
        write("far.toml", replaced(read("it's a game.toml"), "x_m = 1.0, y_m = 1.0", "x_m = 1, y_m = 9.5"));
    RunWatch watch;
    std::vector<std::string> notes;
    watch.opened = [&](const OpenedScenario& opened) { notes = opened.notes; };
    watch.begins = [&](const WorldState& initial, std::int64_t ticks, const std::function<void()>&) {
        EXPECT_EQ(initial.tick, 0);
        EXPECT_EQ(ticks, 5);
        EXPECT_EQ(notes.size(), 1u);
    };
    const auto run = runScenario(far, watch);
    ASSERT_TRUE(run) << run.error().message();
    ASSERT_EQ(run->opened.notes.size(), 1u);
    EXPECT_THAT(notes[0], testing::StartsWith("\"two\" starts at (1.0, 9.5)"));
}

TEST_F(Running, IsEndedByItsWatchAndKeepsWhatWasRecorded) {
    RunRequest recorded = request(100);
    recorded.recording = path("game.mcap");
    recorded.command = "as I say";
    RunWatch watch;
    watch.each = [](const WorldState& state) { return state.tick < 30; };
    const auto run = runScenario(recorded, watch);
    ASSERT_TRUE(run) << run.error().message();
    EXPECT_EQ(run->result.end, RunEnd::stopped);
    EXPECT_EQ(run->result.state.tick, 30);
    EXPECT_TRUE(run->recorded);
    const auto opened = openRecording(path("game.mcap"));
    ASSERT_TRUE(opened) << opened.error().message();
    EXPECT_EQ(opened->branches[0].timeline.last(), 30);
    EXPECT_EQ(opened->header.commandLine, "as I say");
    EXPECT_TRUE(opened->damage.empty());
    expectError(runScenario(recorded), path("game.mcap"), {"is there already"});
    recorded.overwrite = true;
    recorded.recording = game();
    expectError(runScenario(recorded), game(), {"is read by this command"});
}

TEST_F(Running, LostRecordingIsSaidAndTheRunGoesOn) {
    RunRequest recorded = request(4);
    recorded.recording = path("game.mcap");
    RunWatch watch;
    std::function<void()> flush;
    int lost = 0;
    watch.begins = [&](const WorldState&, std::int64_t, const std::function<void()>& writes) { flush = writes; };
    watch.lost = [&](const Error& error) {
        ++lost;
        EXPECT_THAT(error.message(), testing::HasSubstr("; the run goes on, and its recording ends here"));
    };
    watch.each = [&](const WorldState& state) {
        if (state.tick == 10) std::filesystem::remove(path("game.mcap"));
        flush();
        return true;
    };
    const auto run = runScenario(recorded, watch);
    ASSERT_TRUE(run) << run.error().message();
    EXPECT_EQ(run->result.end, RunEnd::duration);
    EXPECT_EQ(lost, 1);
    EXPECT_TRUE(run->lost);
    EXPECT_FALSE(run->recorded);
}

TEST_F(Running, RecordingIsReplayedAndEndedByItsWatch) {
    RunRequest recorded = request();
    recorded.recording = path("game.mcap");
    ASSERT_TRUE(runScenario(recorded));
    for (const bool decide : {false, true}) {
        const auto replayed = replayRecording({recorded.recording, decide});
        ASSERT_TRUE(replayed) << replayed.error().message();
        EXPECT_EQ(replayed->report.ticks, 50);
        EXPECT_FALSE(replayed->report.difference);
        EXPECT_FALSE(replayed->report.cancelled);
        EXPECT_TRUE(replayed->notes.empty());
    }
    ReplayWatch watch;
    watch.progress = [](std::int64_t, std::int64_t) { return false; };
    const auto ended = replayRecording({recorded.recording}, watch);
    ASSERT_TRUE(ended) << ended.error().message();
    EXPECT_TRUE(ended->report.cancelled);
    expectError(replayRecording({game()}), game());
    const std::string whole = read("game.mcap"), cut = write("cut.mcap", whole.substr(0, whole.size() * 2 / 3));
    if (const auto part = replayRecording({cut})) {
        ASSERT_EQ(part->notes.size(), 1u);
        EXPECT_EQ(part->notes[0].file, cut);
        EXPECT_THAT(part->notes[0].cause, testing::HasSubstr("; kept: "));
    }
}

TEST_F(Running, BatchIsEndedAndGoesOn) {
    BatchRequest batch{{game()}, path("games")};
    batch.duration = 0.5;
    batch.trials = 6;
    batch.until = "time > 99";
    batch.scenario.overrides = {"robot[\"two\"].start.heading_deg=45"};
    BatchWatch watch;
    std::atomic<int> begun = 0;
    watch.runBegins = [&](const RunKey&) { ++begun; };
    watch.goesOn = [&] { return begun < 3; };
    const auto ended = runBatch(batch, watch);
    ASSERT_TRUE(ended) << ended.error().message();
    EXPECT_FALSE(ended->complete);
    const auto whole = runBatch(batch);
    ASSERT_TRUE(whole) << whole.error().message();
    EXPECT_TRUE(whole->complete);
    EXPECT_EQ(whole->runs, 6);
    EXPECT_EQ(whole->resumed, ended->results.rows);
    const auto rows = csvRows(read("games/results.csv"));
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_EQ(
        rows[1].at("command"),
        "mrose run '" + replaced(game(), "it's", "it'\\''s") +
            "' --set 'robot[\"two\"].start.heading_deg=45' --isolate --duration 0.5 --until 'time > 99' --trial 2 "
            "--seed 5");
    batch.duration = 0.6;
    const auto other = runBatch(batch);
    ASSERT_FALSE(other);
    EXPECT_THAT(other.error().message(), testing::HasSubstr("--duration"));
}

TEST_F(Running, RowsOfABatchSayHowTheirRunsAreOpened) {
    BatchRequest batch{{game()}, path("games")};
    batch.duration = 0.2;
    batch.trials = 2;
    batch.seeds = {{3, 4}};
    ASSERT_TRUE(runBatch(batch));
    const auto table = readTrials(path("games/results.csv"));
    ASSERT_TRUE(table) << table.error().message();
    const auto rows = csvRows(read("games/results.csv"));
    ASSERT_EQ(table->rows.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const TrialRow& row = table->rows[i];
        EXPECT_EQ(row.request.file, game());
        EXPECT_EQ(std::to_string(row.request.trial), rows[i].at("trial"));
        EXPECT_EQ(std::to_string(row.request.seed.value()), rows[i].at("seed"));
        EXPECT_EQ(row.end, 0.2);
        ASSERT_EQ(row.cells.size(), table->columns.size());
        for (std::size_t column = 0; column < row.cells.size(); ++column)
            EXPECT_EQ(row.cells[column], rows[i].at(table->columns[column]));
    }
    const std::string header = read("games/results.csv").substr(0, read("games/results.csv").find('\n') + 1);
    expectError(readTrials(write("cut.csv", header + "1,3\n")), path("cut.csv"), {"cut.csv:2: ", "no row of a batch"});
    expectError(readTrials(write("none.csv", header)), path("none.csv"), {"holds no runs"});
    expectError(readTrials(write("other.csv", "a,b\n1,2\n")), path("other.csv"), {"other.csv:1: ", "mrose batch"});
}

/// One that branches, and one that does not.
TEST_F(Running, TrialOfAnExperimentIsMeasuredAsInItsRow) {
    const std::string both = "format = \"mrose experiment\"\nversion = 1\nname = \"way\"\nscenario = \"" + game() +
                             R"("
trials = 2
seeds = 2
duration_s = 2.0
until = 'robot[1].x - draw.x > 0.4'
[[draw]]
name = "x"
path = "robot[1].start.x_m"
from = -1.0
to = -0.5
[[variant]]
name = "as it is"
[[variant]]
name = "it stands"
set = { "robot[1].controller" = { kind = "wander", speed_mps = 0.0, rotation_degps = 0.0 } }
[features]
at = 'robot[1].x'
aim = 'robot[1].controller["aim x"]'
[measures]
gone = 'robot[1].x - draw.x'
fastest = { most = 'robot[1].speed' }
)";
    for (const std::string branches : {"", "branch = 'robot[1].x - draw.x > 0.1'\n"}) {
        std::string text = both;
        text.insert(text.find("[[draw]]"), branches);
        const std::string folder = path(branches.empty() ? "whole" : "branched");
        const std::string file = write(branches.empty() ? "whole.toml" : "branched.toml", text);
        const auto done = runExperiment({file, folder});
        ASSERT_TRUE(done) << done.error().message();
        const auto rows = csvRows(read(std::filesystem::path(folder).filename().string() + "/results.csv"));
        ASSERT_EQ(rows.size(), 8u);
        for (const auto& row : rows) {
            const RunRequest one = requestOf(row, file);
            const auto run = runScenario(one);
            ASSERT_TRUE(run) << run.error().message();
            ASSERT_EQ(run->measured.size(), 4u);
            for (const auto& [name, value] : run->measured) EXPECT_EQ(numberText(value), row.at(name)) << name;
            EXPECT_EQ(name(run->result.end), row.at("end"));
        }
    }
    const auto game = runScenario(request());
    ASSERT_TRUE(game);
    EXPECT_TRUE(game->measured.empty());
    std::string misspelt = both;
    misspelt.replace(misspelt.find("controller[\"aim x\"]"), 19, "controller.aims_x");
    expectError(runScenario({{write("misspelt.toml", misspelt)}}), path("misspelt.toml"),
                {"features.aim: there is no 'aims_x' in 'controller'"});
}

/// A trial that does not branch, one with a fault before, and one whose features cannot be asked at the branch.
TEST_F(Running, TrialsThatDoNotBranchAreRepeatedUpToWhereTheyWould) {
    const std::string text = "format = \"mrose experiment\"\nversion = 1\nname = \"way\"\nscenario = \"" + game() +
                             R"("
trials = 12
seeds = 2
duration_s = 0.4
branch_within_s = 0.6
branch = 'draw.how > 0 and time > 0.2 and (draw.how ~= 3 or 5)'
[[draw]]
name = "how"
of = [1, 0, 3, 2]
[[variant]]
name = "as it is"
[[variant]]
name = "it stands"
set = { "robot[1].controller" = { kind = "wander", speed_mps = 0.0, rotation_degps = 0.0 } }
[features]
at = 'draw.how == 2 and time > 0.1 and "late" or time'
[measures]
x = 'robot[1].x'
)";
    const std::string file = write("branched.toml", text);
    const auto done = runExperiment({file, path("out")});
    ASSERT_TRUE(done) << done.error().message();
    std::set<std::string> kinds;
    for (const auto& row : csvRows(read("out/results.csv"))) {
        const RunRequest one = requestOf(row, file);
        const auto run = runScenario(one);
        kinds.insert(row.at("draw.how") + ' ' + row.at("end"));
        if (row.at("end") == "fault") {
            ASSERT_FALSE(run) << row.at("draw.how");
            EXPECT_EQ(run.error().message(), row.at("fault"));
            continue;
        }
        ASSERT_TRUE(run) << run.error().message();
        EXPECT_EQ(name(run->result.end), row.at("end"));
        EXPECT_EQ(hexadecimal(hashOf(run->result.state).world), row.at("world_hash"));
        const bool branches = row.at("end") != "no branch";
        EXPECT_EQ(run->measured.empty(), !branches);
        ASSERT_EQ(run->opened.notes.empty(), branches);
        if (!branches) {
            OpenRequest window{file};
            window.trial = one.scenario.trial, window.variant = one.scenario.variant, window.seed = one.seed;
            const auto shown = openRun(window);
            ASSERT_TRUE(shown) << shown.error().message();
            EXPECT_EQ(shown->start.seed, run->result.state.seed) << "of the trial's first run";
            EXPECT_THAT(run->opened.notes[0],
                        testing::HasSubstr("trial " + row.at("trial") + " does not branch within 0.6 s"));
        }
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"0 no branch", "1 duration", "2 fault", "3 fault"}));
}

/// What the row says is wrong, not what else cannot be asked at the start. What the first trial cannot answer is told
/// before any, so that one of two halves is wrong.
TEST_F(Running, FaultOfATrialIsThatOfItsRow) {
    std::size_t faults = 0;
    for (const std::string right : {"draw.how > 0", "draw.how < 1"}) {
        const std::string file =
            write("x.toml", "format = \"mrose experiment\"\nversion = 1\nname = \"way\"\nscenario = \"" + game() +
                                "\"\ntrials = 8\nduration_s = 0.1\nuntil = '" + right +
                                " or 5'\n[[draw]]\nname = \"how\"\nof = [0, 1]\n[features]\nat = '" + right +
                                " and 1 or \"a\"'\n");
        if (!runExperiment({file, path("out")})) continue;
        for (const auto& row : csvRows(read("out/results.csv"))) {
            RunRequest one{{file}};
            one.scenario.trial = static_cast<std::uint32_t>(std::stoul(row.at("trial")));
            const auto run = runScenario(one);
            EXPECT_EQ(run.has_value(), row.at("end") != "fault");
            if (run) continue;
            ++faults;
            EXPECT_EQ(run.error().message(), row.at("fault"));
        }
    }
    EXPECT_GT(faults, 0u);
}

TEST_F(Running, OverridesThatATrialDoesNotKeepAreRefused) {
    const std::string file =
        write("x.toml", "format = \"mrose experiment\"\nversion = 1\nname = \"way\"\nscenario = \"" + game() + R"("
trials = 1
duration_s = 0.1
[[draw]]
name = "x"
path = "robot[1].start.x_m"
from = -1.0
to = -0.5
[[draw]]
name = "other"
path = "robot[2].start.x_m"
from = 1.0
to = 1.5
[[variant]]
name = "light"
set = { "robot[1].type.mass_kg" = 5.0, "robot[1].start.y_m" = 0.3 }
[[variant]]
name = "as it is"
)");
    const std::string head = "format = \"mrose settings\"\nversion = 1\n[set]\n";
    const std::string drawn =
        write("drawn.toml", head + "\"robot[*].type.mass_kg\" = 7.0\n\"robot[1].start.x_m\" = 0.5\n");
    const std::string heavy = write("heavy.toml", head + "\"robot[1].type.mass_kg\" = 7.0\n");
    const std::string both =
        write("both.toml", head + "\"robot[1].type.mass_kg\" = 7.0\n\"robot[1].start.heading_deg\" = 9.0\n");
    const auto opened = [&](const std::string& variant, const std::string& settings, const std::string& set = {}) {
        ScenarioRequest request{file};
        request.variant = variant, request.trial = 1;
        if (!settings.empty()) request.settings = {settings};
        if (!set.empty()) request.overrides = {set};
        return openScenario(request);
    };
    expectError(opened("as it is", drawn), drawn,
                {"drawn.toml:5:24: robot[1].start.x_m: has no effect: draw \"x\" sets it in each trial"});
    expectError(opened("as it is", "", "robot[*].start.x_m=0"), "",
                {"--set robot[*].start.x_m: has no effect: draws set each of its elements in each trial"});
    expectError(opened("light", heavy), heavy, {"has no effect: variant \"light\" sets all that it does"});
    expectError(opened("light", "", "robot[1].type.mass_kg=7"), "",
                {"--set robot[1].type.mass_kg: has no effect: variant \"light\" sets it"});
    const auto massOf = [](const Expected<OpenedScenario>& of) { return of->scenario->scene().typeOf(0).mass; };
    const auto plain = opened("as it is", heavy, "robot[1].start.y_m=0.1");
    ASSERT_TRUE(plain) << plain.error().message();
    EXPECT_EQ(massOf(plain), 7);
    const auto partly = opened("light", both);
    ASSERT_TRUE(partly) << partly.error().message();
    EXPECT_EQ(massOf(partly), 5);
    EXPECT_THAT(partly->notes,
                testing::Contains(both + ":4:27: robot[1].type.mass_kg: has no effect: variant \"light\" sets it"));
    // Rows of each variant are repeated with what it keeps.
    ExperimentRequest all{file, path("out")};
    all.settings = {heavy, both}, all.overrides = {"robot[1].start.y_m=0.1"};
    const auto done = runExperiment(all);
    ASSERT_TRUE(done) << done.error().message();
    const auto rows = readTrials(path("out/results.csv"));
    ASSERT_TRUE(rows) << rows.error().message();
    ASSERT_EQ(rows->rows.size(), 2u);
    EXPECT_EQ(rows->rows[0].request.settings, std::vector<std::string>{both});
    EXPECT_TRUE(rows->rows[0].request.overrides.empty());
    EXPECT_EQ(rows->rows[1].request.settings, (std::vector<std::string>{heavy, both}));
    EXPECT_EQ(rows->rows[1].request.overrides, std::vector<std::string>{"robot[1].start.y_m=0.1"});
}

TEST_F(Running, ConditionsKnowWhatWasDrawnForATrial) {
    const std::string file =
        write("x.toml", "format = \"mrose experiment\"\nversion = 1\nname = \"way\"\nscenario = \"" + game() + R"("
trials = 1
duration_s = 0.5
[[draw]]
name = "when"
from = 0.1
to = 0.2
)");
    RunRequest one{{file}};
    one.until = "time > draw.when";
    const auto run = runScenario(one);
    ASSERT_TRUE(run) << run.error().message();
    EXPECT_EQ(run->result.end, RunEnd::condition);
    const double when = *run->opened.trial->drawn[0].value.asFloat();
    const double time = toSeconds(run->scenario().scene().timeOf(run->result.state.tick));
    EXPECT_GT(time, when);
    EXPECT_LE(time, when + toSeconds(run->scenario().scene().tickLength));
    OpenRequest window{file};
    window.trial = 1;
    const auto shown = openRun(window);
    ASSERT_TRUE(shown) << shown.error().message();
    EXPECT_TRUE(checkBreakText("draw.when > 0.15", *shown->setup, nullptr));
    EXPECT_FALSE(checkBreakText("draw.where > 0.15", *shown->setup, nullptr));
    one.until = "time > draw.where";
    expectError(runScenario(one), "--until", {"there is no draw 'where': there are 'when'"});
    expectError(runScenario({.scenario = {game()}, .until = "time > draw.when"}), "--until", {"'draw' is known in"});
}

TEST_F(Running, FileThatAnOverrideNamesIsSoughtHereToo) {
    const auto missing = openScenario({.file = game(), .overrides = {"robot[1].network=none.net"}});
    const std::string here = (std::filesystem::current_path() / "none.net").string();
    expectError(missing, game(), {"\"none.net\" was not found; expected " + here + ", " + path("none.net") + " or "});
}

TEST_F(Running, BatchOfSeveralSeedsAndAWrongCondition) {
    BatchRequest batch{{game()}, path("games")};
    batch.duration = 0.1;
    batch.trials = 2;
    batch.seeds = {{3, 5}};
    const auto summary = runBatch(batch);
    ASSERT_TRUE(summary) << summary.error().message();
    EXPECT_EQ(summary->runs, 6);
    batch.folder = path("others");
    batch.until = "speed(";
    expectError(runBatch(batch), "--until");
    EXPECT_FALSE(std::filesystem::exists(path("others")));
}

}  // namespace
}  // namespace mrose
