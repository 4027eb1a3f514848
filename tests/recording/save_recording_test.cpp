#include "recording/save_recording.h"

#include <gtest/gtest.h>

#include "io/file.h"
#include "recording/mcap_walk.h"
#include "recording/playback.h"
#include "recording/recording_fixture.h"
#include "recording/replay.h"
#include "support/full_disk.h"
#include "world/state_bytes.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

/// Someone takes over robot 2 for some ticks.
std::vector<RobotDecision> handOnTwo(std::int64_t tick) {
    Decision decision;
    decision.command = Command{0.7, -0.0};
    return tick >= 100 && tick < 150 ? std::vector<RobotDecision>{{2, decision}} : std::vector<RobotDecision>{};
}

std::string decisionsOf(const Timeline& timeline) {
    std::string all;
    for (const TimelineBlock& block : timeline.blocks()) all += block.decisions;
    return all;
}

/// A run in which the user took over, a branch of it, a branch of that one, and one of another scenario.
class SavedRecording : public RecordingFile {
protected:
    void add(const StraightRun& straight, std::uint32_t branch) {
        for (std::size_t i = 0; i < straight.traces.size(); ++i)
            history.add(straight.states[i + 1], straight.traces[i], branch);
    }
    void fill() {
        history.rename(0, "as it was");
        add(guided, 0);
        add(branchRun, history.beginBranch(0, branchRun.states.front(), "pushed"));
        add(second, history.beginBranch(1, second.states.front(), "pushed again"));
        add(fewer, history.beginBranch(0, fewer.states.front(), "fewer", fewerValue));
    }
    Expected<bool> save(const SaveRecordingOptions& options = {}) {
        return saveRecording(path, history.branches(), scenarios, value, options);
    }
    std::vector<std::string> listing() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
            names.push_back(entry.path().filename().string());
        return names;
    }
    static MatchOptions three() {
        MatchOptions options;
        options.robots = 3;
        return options;
    }

    std::filesystem::path path = folder.path() / "saved.mcap";
    std::shared_ptr<const Scenario> whole = std::make_shared<const Scenario>(matchParts());
    std::shared_ptr<const Scenario> few = std::make_shared<const Scenario>(matchParts(three()));
    std::vector<std::shared_ptr<const Scenario>> scenarios{whole, whole, whole, few};
    ScenarioValuePointer fewerValue = valueOf("few.toml", 9);
    StraightRun guided = runMatch(*whole, whole->initialState(), ticks, handOnTwo);
    StraightRun second = runMatch(*whole, pushed(branchRun.states[20]), 50);
    StraightRun fewer = runMatch(*few, few->initialState(9), 80);
    History history{guided.states.front(), {std::size_t{1} << 28, 35}};
};

TEST_F(SavedRecording, ComesBackAsItWasKept) {
    fill();
    SaveRecordingOptions options;
    options.commandLine = "mrose-gui x";
    options.origin.step = 7;
    const auto saved = save(options);
    ASSERT_TRUE(saved) << saved.error().message();
    EXPECT_TRUE(*saved);
    EXPECT_EQ(listing(), std::vector<std::string>{"saved.mcap"});
    const auto recording = openRecording(path);
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->damage.empty()) << recording->damage.front();
    EXPECT_EQ(recording->header.commandLine, "mrose-gui x");
    EXPECT_EQ(recording->header.origin, options.origin);
    ASSERT_EQ(recording->branches.size(), 4u);
    for (std::uint32_t i = 0; i < 4; ++i) {
        const Branch &kept = history.branches()[i], &read = recording->branches[i];
        EXPECT_EQ(read.name, kept.name);
        EXPECT_EQ(read.parent, kept.parent);
        EXPECT_EQ(read.tick, kept.tick);
        EXPECT_EQ(*recording->valueOf(i), i == 3 ? *fewerValue : *value);
        ASSERT_EQ(read.timeline.first(), kept.timeline.first());
        ASSERT_EQ(read.timeline.last(), kept.timeline.last());
        for (std::int64_t tick = read.timeline.first() + 1; tick <= read.timeline.last(); ++tick)
            EXPECT_EQ(read.timeline.hashAt(tick), kept.timeline.hashAt(tick)) << i << ' ' << tick;
        EXPECT_EQ(decisionsOf(read.timeline), decisionsOf(kept.timeline));
        EXPECT_EQ(read.timeline.blocks().size(), kept.timeline.blocks().size());
    }
    expectStates(recording->branches[0].timeline, guided);
    expectStates(recording->branches[2].timeline, second);
    for (const bool decide : {false, true}) {
        const auto report = replay(recording->branches, scenarios, {decide, {}});
        ASSERT_TRUE(report);
        EXPECT_FALSE(report->difference) << report->difference->what;
    }
}

/// Also where the controllers are not at hand: what they and the sensors remembered is kept.
TEST_F(SavedRecording, WithoutTheControllersItIsTheSameFile) {
    fill();
    ASSERT_TRUE(save());
    ScenarioParts parts = matchParts();
    for (auto& controller : parts.controllers)
        controller = std::make_shared<const RecordedController>(RecordingHeader::ControllerNeeds{16, 2});
    scenarios[0] = scenarios[1] = scenarios[2] = std::make_shared<const Scenario>(std::move(parts));
    const std::filesystem::path first = path;
    path = folder.path() / "again.mcap";
    ASSERT_TRUE(save());
    EXPECT_EQ(*readFile(path), *readFile(first));
}

/// Other programs see in it what they see in a recording that was written while it ran.
TEST_F(SavedRecording, HasTheMessagesOfARecordingWrittenMeanwhile) {
    scenarios = {whole, whole};
    add(run, 0);
    add(branchRun, history.beginBranch(0, branchRun.states.front(), "pushed"));
    ASSERT_TRUE(save());
    const auto countsOf = [](const std::string& file) {
        std::string counts;
        for (const WalkedRecord& part : walkRecords(file))
            if (part.kind == 0x0b) {
                // All but how many chunks and attachments there are.
                counts = std::string(part.content.substr(0, 14)) + std::string(part.content.substr(26));
            }
        return counts;
    };
    const std::string live = countsOf(*readFile(record()));
    ASSERT_FALSE(live.empty());
    EXPECT_EQ(countsOf(*readFile(path)), live);
}

TEST_F(SavedRecording, BeginsWithTheEarliestThatIsKept) {
    const StraightRun longer = runMatch(*whole, whole->initialState(), 600);
    Timeline all(longer.states.front(), 25);
    for (std::size_t i = 0; i < longer.traces.size(); ++i) all.add(longer.states[i + 1], longer.traces[i]);
    History small(longer.states.front(), {all.size() / 2, 25});
    const std::uint32_t branch = small.beginBranch(0, longer.states.front(), "from the start");
    for (std::size_t i = 0; i < longer.traces.size(); ++i) small.add(longer.states[i + 1], longer.traces[i]);
    small.add(longer.states[1], longer.traces[0], branch);
    ASSERT_GT(small.branches()[0].timeline.first(), 200);
    const auto saved = saveRecording(path, small.branches(), std::vector{whole, whole}, value);
    ASSERT_TRUE(saved) << saved.error().message();
    const auto recording = openRecording(path);
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->damage.empty());
    const Timeline& timeline = recording->branches[0].timeline;
    EXPECT_EQ(timeline.first(), small.branches()[0].timeline.first());
    EXPECT_EQ(timeline.last(), 600);
    EXPECT_EQ(recording->branches[1].tick, 0);
    Playback playback(*whole);
    for (std::int64_t tick = timeline.first(); tick <= 600; tick += 11)
        EXPECT_FALSE(
            firstDifference(longer.states[static_cast<std::size_t>(tick)], playback.reach(timeline, tick)->state));
    EXPECT_FALSE(replay(recording->branches, *whole)->difference);
}

TEST_F(SavedRecording, FullDiskLeavesTheOldFile) {
    fill();
    ASSERT_TRUE(save());
    const std::uintmax_t size = std::filesystem::file_size(path);
    folder.write("saved.mcap", "precious");
    SaveRecordingOptions options;
    options.overwrite = true;
    for (std::uintmax_t room = 0; room < size; room += size / 23) {
        Expected<bool> saved = true;
        {
            const FullDisk full(room);
            saved = save(options);
        }
        ASSERT_FALSE(saved) << room;
        EXPECT_TRUE(saved.error().message().starts_with(path.string() + ": cannot be written: "))
            << saved.error().message();
        EXPECT_EQ(*readFile(path), "precious");
        EXPECT_EQ(listing(), std::vector<std::string>{"saved.mcap"});
    }
    ASSERT_TRUE(save(options));
    EXPECT_EQ(std::filesystem::file_size(path), size);
}

TEST_F(SavedRecording, WhoEndsItFindsTheOldFile) {
    fill();
    folder.write("saved.mcap", "precious");
    const std::int64_t all = ticks + branchTicks + 50 + 80;
    SaveRecordingOptions options;
    options.overwrite = true;
    for (const std::int64_t end : {0, 64, 230, 300, 420}) {
        std::int64_t last = 0;
        options.progress = [&](std::int64_t done, std::int64_t of) {
            EXPECT_EQ(of, all);
            EXPECT_GE(done, last);
            last = done;
            return done < end;
        };
        const auto saved = save(options);
        ASSERT_TRUE(saved) << saved.error().message();
        EXPECT_FALSE(*saved) << end;
        EXPECT_EQ(*readFile(path), "precious");
        EXPECT_EQ(listing(), std::vector<std::string>{"saved.mcap"});
    }
    std::int64_t last = 0;
    options.progress = [&](std::int64_t done, std::int64_t) { return last = done, true; };
    EXPECT_TRUE(*save(options));
    EXPECT_EQ(last, all);
    EXPECT_TRUE(openRecording(path));
}

TEST_F(SavedRecording, WhatCannotBeSavedIsSaid) {
    fill();
    folder.write("saved.mcap", "precious");
    EXPECT_EQ(save().error().message(), path.string() + ": is there already; --overwrite replaces it");
    path = folder.path() / "no" / "x.mcap";
    EXPECT_EQ(save().error().message(), path.string() + ": cannot be written: No such file or directory");
    path = folder.path();
    EXPECT_EQ(save().error().message(), path.string() + ": is a folder; expected a file");
    path = folder.path() / "x.mcap";
    scenarios[2] = few;
    EXPECT_EQ(
        save().error().message(),
        path.string() + ": the beginning of branch 2 is none of its scenario: it has 8 robots; the scenario has 3");
    EXPECT_EQ(listing(), std::vector<std::string>{"saved.mcap"});
}

/// A recording that was opened goes on as if it had never been closed, and can be saved again.
TEST_F(SavedRecording, OpenedHistoryGoesOn) {
    const auto half = [](const StraightRun& straight, std::ptrdiff_t count) {
        return StraightRun{{straight.states.begin(), straight.states.begin() + count + 1},
                           {straight.traces.begin(), straight.traces.begin() + count}};
    };
    add(half(guided, 120), 0);
    add(half(branchRun, 40), history.beginBranch(0, branchRun.states.front(), "pushed"));
    scenarios = {whole, whole};
    ASSERT_TRUE(save());
    auto recording = openRecording(path);
    ASSERT_TRUE(recording);
    History opened(std::move(recording->branches));
    Playback playback(*whole);
    const auto goOn = [&](std::uint32_t branch, std::int64_t to, const OutsideDecisions& outside) {
        const Timeline& timeline = opened.branches()[branch].timeline;
        WorldState state = playback.reach(timeline, timeline.last())->state;
        StepBuffers buffers;
        StepTrace trace;
        while (state.tick < to) {
            step(*whole, state, buffers, {outside(state.tick), true}, &trace);
            opened.add(state, trace, branch);
        }
    };
    goOn(0, ticks, handOnTwo);
    goOn(1, branchTick + branchTicks, [](std::int64_t) { return std::vector<RobotDecision>(); });
    const std::uint32_t third = opened.beginBranch(1, second.states.front(), "again");
    EXPECT_EQ(third, 2u);
    for (std::size_t i = 0; i < second.traces.size(); ++i) opened.add(second.states[i + 1], second.traces[i], third);
    expectStates(opened.branches()[0].timeline, guided);
    expectStates(opened.branches()[1].timeline, branchRun);
    expectStates(opened.branches()[2].timeline, second);
    // What was added lies in blocks as long as usual, not of a tick each.
    EXPECT_LE(opened.branches()[0].timeline.blocks().size(), 6u);
    scenarios = {whole, whole, whole};
    SaveRecordingOptions options;
    options.overwrite = true;
    ASSERT_TRUE(saveRecording(path, opened.branches(), scenarios, value, options));
    const auto again = openRecording(path);
    ASSERT_TRUE(again);
    EXPECT_FALSE(replay(again->branches, *whole, {true, {}})->difference);
    expectStates(again->branches[0].timeline, guided);
}

}  // namespace
}  // namespace mrose
