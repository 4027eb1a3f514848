// Branches that run in another scenario than the run: in memory, in a file, replayed.
#include "recording/branch_scenario.h"

#include <gtest/gtest.h>

#include "io/bytes.h"
#include "io/compression.h"
#include "io/file.h"
#include "recording/mcap_walk.h"
#include "recording/playback.h"
#include "recording/recording_fixture.h"
#include "recording/replay.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

std::shared_ptr<const Scenario> smaller(std::uint32_t robots, std::uint64_t seed) {
    MatchOptions options;
    options.robots = robots;
    ScenarioParts parts = matchParts(options);
    parts.seed = seed;
    parts.scene.tickLength = 10'000'000;
    return std::make_shared<const Scenario>(std::move(parts));
}

/// A run; beside it from tick 0 on one of three robots and another seed; a branch of that one, and one of that which
/// goes back to the run's scenario.
class BranchScenarios : public RecordingFile {
protected:
    std::filesystem::path recordAll() {
        const std::filesystem::path path = folder.path() / "all.mcap";
        auto writer = RecordingWriter::create(path, scenario, run.states.front(), value, "", {.keyframeInterval = 30});
        EXPECT_TRUE(writer);
        const auto add = [&](const StraightRun& straight, std::uint32_t branch) {
            for (std::size_t i = 0; i < straight.traces.size(); ++i)
                writer->add(straight.states[i + 1], straight.traces[i], branch);
        };
        add(run, 0);
        EXPECT_EQ(writer->beginBranch(0, reloaded.states.front(), "reloaded", *other, otherValue), 1u);
        add(reloaded, 1);
        EXPECT_EQ(writer->beginBranch(1, pushedAgain.states.front(), "pushed"), 2u);
        add(pushedAgain, 2);
        EXPECT_EQ(writer->beginBranch(2, branchRun.states.front(), "back", scenario, value), 3u);
        add(branchRun, 3);
        const auto closed = writer->close();
        EXPECT_TRUE(closed) << closed.error().message();
        return path;
    }

    std::vector<std::shared_ptr<const Scenario>> scenarios() const {
        const auto own = std::make_shared<const Scenario>(matchParts());
        return {own, other, other, own};
    }

    /// The bytes of the file with those of the attachment of branch 1's scenario replaced.
    std::string withScenario(const std::string& file, const std::string& data) const {
        for (const WalkedRecord& part : walkRecords(file)) {
            if (part.kind != 9 || part.content.find("mrose/scenario/1") == std::string_view::npos) continue;
            std::string content, record;
            appendNumber(content, std::int64_t{0});
            appendNumber(content, std::int64_t{0});
            mcap::appendText(content, "mrose/scenario/1");
            mcap::appendText(content, "");
            appendLong(content, data);
            appendNumber(content, std::uint32_t{0});
            mcap::appendRecord(record, mcap::Kind::attachment, content);
            return file.substr(0, part.offset) + record + file.substr(part.end);
        }
        ADD_FAILURE() << "no scenario of branch 1";
        return file;
    }

    std::shared_ptr<const Scenario> other = smaller(3, 5);
    ScenarioValuePointer otherValue = valueOf("soccer.toml", 5);
    StraightRun reloaded = runMatch(*other, other->initialState(), 70);
    StraightRun pushedAgain = runMatch(*other, pushed(reloaded.states[40]), 30);
};

TEST_F(BranchScenarios, HistoryKeepsThemAndBranchesInheritThem) {
    History history(run.states.front());
    const ScenarioValuePointer own = otherValue;
    EXPECT_EQ(history.beginBranch(0, reloaded.states.front(), "a", own), 1u);
    EXPECT_EQ(history.beginBranch(1, pushedAgain.states.front(), "b"), 2u);
    EXPECT_EQ(history.beginBranch(0, run.states.front(), "c"), 3u);
    for (std::size_t i = 0; i < reloaded.traces.size(); ++i) history.add(reloaded.states[i + 1], reloaded.traces[i], 1);
    EXPECT_EQ(history.branches()[0].value, nullptr);
    EXPECT_EQ(history.branches()[1].value, own);
    EXPECT_EQ(history.branches()[2].value, own);
    EXPECT_EQ(history.branches()[3].value, nullptr);
    const auto reached = Playback(*other).reach(history.branches()[1].timeline, 70);
    ASSERT_TRUE(reached) << reached.error().message();
    EXPECT_FALSE(firstDifference(reloaded.states[70], reached->state));
}

TEST_F(BranchScenarios, ComeBackFromTheFile) {
    const auto recording = openRecording(recordAll());
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->damage.empty()) << recording->damage.front();
    ASSERT_EQ(recording->branches.size(), 4u);
    const std::vector<ScenarioValuePointer> expected{value, otherValue, otherValue, value};
    const std::vector<std::int64_t> begins{0, 0, 40, 90};
    for (std::uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(*recording->valueOf(i), *expected[i]) << i;
        const bool smaller = i == 1 || i == 2;
        EXPECT_EQ(recording->layouts[i].tickLength, smaller ? 10'000'000 : 20'000'000);
        EXPECT_EQ(recording->layouts[i].controllers,
                  std::vector<RecordingHeader::ControllerNeeds>(smaller ? 3 : 8, {16, 2}));
        EXPECT_EQ(recording->branches[i].tick, begins[i]);
    }
    EXPECT_EQ(recording->branches[2].value, recording->branches[1].value);
    const auto reached = Playback(*other).reach(recording->branches[2].timeline, 63);
    ASSERT_TRUE(reached) << reached.error().message();
    EXPECT_TRUE(reached->worldSame && reached->memoriesSame);
    EXPECT_FALSE(firstDifference(pushedAgain.states[23], reached->state));
    expectStates(recording->branches[3].timeline, branchRun);
}

TEST_F(BranchScenarios, EachBranchIsReplayedInItsOwn) {
    const auto recording = openRecording(recordAll());
    ASSERT_TRUE(recording);
    for (const bool decide : {false, true}) {
        const auto report = replay(recording->branches, scenarios(), {decide, {}});
        ASSERT_TRUE(report) << report.error().message();
        EXPECT_FALSE(report->difference) << report->difference->what;
        EXPECT_EQ(report->ticks, ticks + 70 + 30 + branchTicks);
    }
    EXPECT_FALSE(replay(recording->branches, scenario));
    auto wrong = scenarios();
    ScenarioParts parts = matchParts();
    parts.scene.environment.floor.rollingDeceleration *= 1.5;
    wrong[3] = std::make_shared<const Scenario>(std::move(parts));
    const auto report = replay(recording->branches, wrong);
    ASSERT_TRUE(report && report->difference);
    EXPECT_EQ(report->difference->branch, 3u);
}

/// Other programs see each branch's own bodies.
TEST_F(BranchScenarios, MessagesAreOfTheirBodies) {
    const std::string file = *readFile(recordAll());
    std::size_t schemas = 0, ofThree = 0;
    for (const WalkedRecord& part : walkRecords(file)) {
        if (part.kind == 0x0f) break;  // the summary repeats them
        if (part.kind != 3 || part.content.find("mrose.Bodies") == std::string_view::npos) continue;
        ++schemas;
        ofThree += part.content.find("rover_3") != std::string_view::npos &&
                   part.content.find("rover_4") == std::string_view::npos;
    }
    EXPECT_EQ(schemas, 3u);
    EXPECT_EQ(ofThree, 1u);
}

TEST_F(BranchScenarios, CutOffAnywhereNoBranchIsOfAnother) {
    const std::string whole = *readFile(recordAll());
    std::size_t most = 0;
    for (const WalkedRecord& part : walkRecords(whole))
        for (const std::size_t cut : {part.offset, (part.offset + part.end) / 2, part.end}) {
            const auto recording = parseRecording(std::string_view(whole).substr(0, cut), "all.mcap");
            if (!recording) continue;
            most = std::max(most, recording->branches.size());
            ASSERT_EQ(recording->layouts.size(), recording->branches.size());
            if (recording->branches.size() > 1) {
                EXPECT_EQ(*recording->valueOf(1), *otherValue);
            }
        }
    EXPECT_EQ(most, 4u);
}

TEST_F(BranchScenarios, WhatIsNoScenarioIsDamage) {
    const std::string whole = *readFile(recordAll());
    const Recording::Layout layout{10'000'000, {3, {16, 2}}};
    const std::string good = branchScenarioBytes({1, layout, otherValue}, value.get());
    EXPECT_EQ(parseRecording(withScenario(whole, good), "f")->branches.size(), 4u);
    const ScenarioValue more =
        *value->with("shape", std::make_shared<const DescriptionFile>(DescriptionFile{"another", "another", "text"}));
    const auto asMore = std::make_shared<const ScenarioValue>(*more.with("seed", 6));
    std::string longer = *decompressed(good);
    longer += 'x';
    for (const std::string& bad :
         {std::string(), std::string("no frame"), good.substr(0, good.size() / 2),
          branchScenarioBytes({2, layout, otherValue}, value.get()),
          branchScenarioBytes({1, {0, {}}, otherValue}, value.get()),
          branchScenarioBytes({1, {std::int64_t{1} << 40, {3, {16, 2}}}, otherValue}, value.get()),
          branchScenarioBytes({1, {10'000'000, {4, {16, 2}}}, otherValue}, value.get()),
          branchScenarioBytes({1, {10'000'000, {{16, 2}, {~std::uint64_t{0}, 2}, {16, 2}}}, otherValue}, value.get()),
          branchScenarioBytes({1, {10'000'000, {{16, 2}, {9'000'000'000'000'000'000, 2}, {16, 2}}}, otherValue},
                              value.get()),
          branchScenarioBytes({1, layout, asMore}, &more),  // tells a file by its hash that the run has not
          compressed(longer), compressed("\3" + decompressed(good)->substr(1))}) {
        const auto recording = parseRecording(withScenario(whole, bad), "f");
        ASSERT_TRUE(recording) << recording.error().message();
        EXPECT_EQ(recording->branches.size(), 1u);
        EXPECT_EQ(recording->branches[0].timeline.last(), ticks);
        EXPECT_NE(recording->damage.back().find("from tick 230 on it cannot be used: what lies at byte "),
                  std::string::npos)
            << recording->damage.back();
    }
    // Cut off at every byte it is none either.
    const std::string content = *decompressed(good);
    for (std::size_t size = 0; size < content.size(); ++size)
        EXPECT_FALSE(parseBranchScenario(compressed(content.substr(0, size)), value.get())) << size;
}

}  // namespace
}  // namespace mrose
