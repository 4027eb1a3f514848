// Scenarios: opened, run, recorded, replayed, tried many times.
#include <atomic>

#include <gmock/gmock.h>

#include "io/format.h"
#include "support/game_folder.h"
#include "support/places.h"
#include "workflow/expect_error.h"
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
            RunRequest one{{file}};
            one.scenario.trial = static_cast<std::uint32_t>(std::stoul(row.at("trial")));
            one.scenario.variant = row.at("variant_name");
            one.seed = std::stoull(row.at("seed"));
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
