#include "recording/recording.h"

#include <set>

#include <gtest/gtest.h>

#include "io/file.h"
#include "recording/block_bytes.h"
#include "recording/mcap_walk.h"
#include "recording/playback.h"
#include "recording/recording_fixture.h"
#include "support/recording_metadata.h"
#include "world/command_history.h"
#include "world/noise.h"
#include "world/state_bytes.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

TEST_F(RecordingFile, ComesBackToTheBit) {
    const auto recording = openRecording(record());
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->damage.empty()) << recording->damage.front();
    const RecordingHeader& header = recording->header;
    EXPECT_EQ(*header.value, *value);
    EXPECT_EQ(header.commandLine, "mrose run x");
    EXPECT_EQ(header.name, "match");
    EXPECT_EQ(header.seed, 77u);
    EXPECT_EQ(header.tickLength, 20'000'000);
    EXPECT_EQ(header.origin, thisOrigin());
    EXPECT_EQ(header.controllers, std::vector<RecordingHeader::ControllerNeeds>(8, {16, 2}));

    ASSERT_EQ(recording->branches.size(), 2u);
    EXPECT_EQ(recording->branches[0].timeline.last(), ticks);
    EXPECT_EQ(recording->branches[0].timeline.blocks().size(), 7u);  // every 40 ticks, and the state kept at the end
    EXPECT_EQ(recording->branches[1].timeline.last(), 150);
    EXPECT_EQ(recording->branches[1].tick, 90);
    EXPECT_EQ(recording->branches[1].parent, 0u);
    EXPECT_EQ(recording->branches[1].name, "pushed");
    expectStates(recording->branches[0].timeline, run);
    expectStates(recording->branches[1].timeline, branchRun);
}

/// Cut off anywhere it opens up to there, or says that not even its beginning is whole.
TEST_F(RecordingFile, CutOffAnywhereItOpensUpToThere) {
    const std::string whole = *readFile(record());
    std::set<std::size_t> cuts;
    for (const WalkedRecord& part : walkRecords(whole))
        cuts.insert({part.offset, part.offset + 1, part.offset + 9, (part.offset + part.end) / 2, part.end - 1});
    for (std::size_t cut = 0; cut < whole.size(); cut += 997) cuts.insert(cut);
    std::set<std::int64_t> lasts;
    std::int64_t last = -1;
    for (const std::size_t cut : cuts) {
        const auto recording = parseRecording(std::string_view(whole).substr(0, cut), "run.mcap");
        if (!recording) {
            EXPECT_EQ(last, -1) << "opened when it was shorter: " << cut;
            EXPECT_NE(recording.error().message().find("run.mcap: is"), std::string::npos);
            continue;
        }
        EXPECT_FALSE(recording->damage.empty()) << cut;
        const Timeline& timeline = recording->branches[0].timeline;
        EXPECT_GE(timeline.last(), last);
        last = timeline.last();
        lasts.insert(last);
        const auto reached = Playback(scenario).reach(timeline, last);
        ASSERT_TRUE(reached);
        ASSERT_FALSE(firstDifference(run.states[static_cast<std::size_t>(last)], reached->state));
    }
    // Parts end where a keyframe is due, where the program flushed, and where the branch began.
    EXPECT_EQ(lasts, (std::set<std::int64_t>{0, 18, 19, 40, 80, 101, 120, 121, 160, 200, 230}));
}

/// One wrong byte anywhere is noticed.
TEST_F(RecordingFile, DamagedBytesAreNamed) {
    const std::string whole = *readFile(record());
    for (std::size_t at = 8; at < whole.size(); at += 211) {
        std::string wrong = whole;
        wrong[at] = static_cast<char>(wrong[at] ^ 0x10);
        const auto recording = parseRecording(wrong, "run.mcap");
        if (!recording) continue;
        EXPECT_FALSE(recording->damage.empty()) << at;
        const Timeline& timeline = recording->branches[0].timeline;
        const auto reached = Playback(scenario).reach(timeline, timeline.last());
        ASSERT_TRUE(reached);
        EXPECT_FALSE(firstDifference(run.states[static_cast<std::size_t>(timeline.last())], reached->state)) << at;
    }
}

TEST_F(RecordingFile, DamageSaysWhatAndWhere) {
    const std::string whole = *readFile(record());
    const auto damageAfter = [&](std::uint8_t kind, std::size_t number, std::size_t into) {
        std::string wrong = whole;
        for (const WalkedRecord& part : walkRecords(whole))
            if (part.kind == kind && number-- == 0) wrong[part.offset + into] ^= 1;
        const auto recording = parseRecording(wrong, "run.mcap");
        return recording ? recording->damage.at(0) : recording.error().message();
    };
    std::size_t chunk = 0, block = 0;
    for (const WalkedRecord& part : walkRecords(whole)) {
        if (part.kind == 6 && chunk == 0) chunk = part.offset;
        if (part.kind == 9 && part.content.find("mrose/block/0/19") != std::string_view::npos) block = part.offset;
    }
    EXPECT_EQ(damageAfter(6, 0, 200),
              "the chunk at byte " + std::to_string(chunk) + " is damaged: its bytes do not fit its CRC");
    std::size_t number = 0;
    for (const WalkedRecord& part : walkRecords(whole)) number += part.kind == 9 && part.offset < block;
    EXPECT_EQ(damageAfter(9, number, 100),
              "the attachment at byte " + std::to_string(block) + " is damaged: its bytes do not fit its CRC");
    EXPECT_NE(damageAfter(0x0c, 0, 30).find("do not fit"), std::string::npos);
    EXPECT_NE(damageAfter(0x0b, 0, 12).find("summary"), std::string::npos);
    EXPECT_NE(damageAfter(9, 1, 100).find("is a recording without a beginning: the attachment"), std::string::npos);
}

TEST_F(RecordingFile, KeyframesOfOtherTicksAreRefused) {
    TimelineBlock block{3, stateBytes(run.states[3]), {}, {}};
    ASSERT_TRUE(parseBlock(blockBytes(block, 0)));
    ASSERT_TRUE(parseBranch(branchBytes({0, 0, "", block})));
    block.first = 4;
    EXPECT_FALSE(parseBlock(blockBytes(block, 0)));
    EXPECT_FALSE(parseBranch(branchBytes({0, 0, "", block})));
    block.first = -1;
    block.keyframe.clear();
    EXPECT_FALSE(parseBlock(blockBytes(block, 0)));
}

TEST_F(RecordingFile, MissingTicksEndIt) {
    std::string file = *readFile(record());
    for (const WalkedRecord& part : walkRecords(file))
        if (part.kind == 9 && part.content.find("mrose/block/0/101") != std::string_view::npos) {
            file.erase(part.offset, part.end - part.offset);
            break;
        }
    const auto recording = parseRecording(file, "run.mcap");
    ASSERT_TRUE(recording);
    EXPECT_EQ(recording->branches[0].timeline.last(), 101);
    EXPECT_NE(recording->damage.back().find("from tick 101 on it cannot be used"), std::string::npos);
}

/// What controllers ask for lays out the states: it is checked against the first of them, whatever CRC holds.
TEST_F(RecordingFile, ControllersAskForNoMoreThanTheirStateHolds) {
    const std::string whole = *readFile(record());
    const mcap::Strings needs = metadataOf(whole, "mrose.controllers");
    ASSERT_EQ(needs.size(), 8u);
    const auto opened = [&](const mcap::Strings& strings) {
        return parseRecording(withMetadata(whole, "mrose.controllers", strings), "run.mcap");
    };
    ASSERT_TRUE(opened(needs)) << opened(needs).error().message();
    EXPECT_EQ(opened(needs)->branches[0].timeline.last(), ticks);
    const auto refusal = [&](const std::string& key, const std::string& value) {
        mcap::Strings wrong = needs;
        wrong[key] = value;
        const auto recording = opened(wrong);
        return recording ? "" : recording.error().message();
    };
    for (const char* huge : {"9000000000000000000", "18446744073709551615", "129"})
        EXPECT_EQ(refusal("3", std::string(huge) + " 2"), "run.mcap: mrose.controllers: asks for " + std::string(huge) +
                                                              " bytes of memory for robot 4; its first state holds "
                                                              "128 for all");
    EXPECT_EQ(refusal("3", "32 2"),
              "run.mcap: mrose.controllers: asks for 144 bytes of memory; its first state holds 128 for all");
    EXPECT_EQ(refusal("8", "0 1"), "run.mcap: mrose.controllers: lists 9 robots; its first state has 8");
    EXPECT_NE(refusal("3", "18446744073709551616 2").find("expected two integers"), std::string::npos);
}

TEST_F(RecordingFile, TicksBeyondAllRunsAreRefused) {
    const std::string whole = *readFile(record());
    mcap::Strings run = metadataOf(whole, "mrose.run");
    for (const char* length : {"0", "-5", "1000000001", "9000000000000000000"}) {
        run["tick_length_ns"] = length;
        const auto recording = parseRecording(withMetadata(whole, "mrose.run", run), "run.mcap");
        ASSERT_FALSE(recording) << length;
        EXPECT_EQ(recording.error().message(), "run.mcap: tick_length_ns: expected an integer of 1 to 1000000000");
    }
}

TEST_F(RecordingFile, OpensAsFarAsTheMemoryGoes) {
    const std::string whole = *readFile(record());
    const auto recording = parseRecording(whole, "run.mcap");
    const std::uint64_t size = recording->branches[0].timeline.size() + recording->branches[1].timeline.size();
    EXPECT_TRUE(parseRecording(whole, "run.mcap", size + 10'000)->damage.empty()) << "with its small scenario";
    std::int64_t last = ticks;
    for (const std::uint64_t most : {size, size / 2, size / 4}) {
        const auto part = parseRecording(whole, "run.mcap", most);
        ASSERT_TRUE(part) << part.error().message();
        EXPECT_LE(part->branches[0].timeline.last(), last);
        last = part->branches[0].timeline.last();
        EXPECT_NE(part->damage.at(0).find("it cannot be used: unpacked it takes more than"), std::string::npos);
    }
    EXPECT_LT(last, ticks);
}

TEST_F(RecordingFile, ControllersHaveNoMoreCommandsThanAHistoryHolds) {
    MatchOptions options;
    for (const std::uint64_t most : {std::uint64_t{CommandHistory::capacity}, ~std::uint64_t{0} / 2 + 1}) {
        options.controller = std::make_shared<const RecordedController>(RecordingHeader::ControllerNeeds{16, most});
        const Scenario greedy(matchParts(options));
        const WorldState state = greedy.initialState();
        EXPECT_EQ(greedy.commandSlots(state, 0).size(), CommandHistory::capacity) << most;
    }
}

TEST_F(RecordingFile, OtherFilesAreNamed) {
    EXPECT_EQ(parseRecording("", "a").error().message(), "a: is no MCAP file: it does not begin as one");
    EXPECT_EQ(parseRecording("x", "a").error().message(), "a: is no MCAP file: it does not begin as one");
    auto other = mcap::Writer::create(folder.path() / "other.mcap", false, "other");
    ASSERT_TRUE(other);
    other->addMetadata("other", {});
    ASSERT_TRUE(other->close());
    EXPECT_NE(openRecording(folder.path() / "other.mcap").error().message().find("is no recording of mrose"),
              std::string::npos);
    auto newer = mcap::Writer::create(folder.path() / "newer.mcap", false, "mrose 9");
    newer->addMetadata("mrose.run", {{"format", "9"}});
    ASSERT_TRUE(newer->close());
    EXPECT_NE(openRecording(folder.path() / "newer.mcap").error().message().find("format 9; expected 2"),
              std::string::npos);
    EXPECT_FALSE(openRecording(folder.path() / "none.mcap"));
}

TEST_F(RecordingFile, NothingIsOverwrittenUnasked) {
    const std::filesystem::path path = folder.write("run.mcap", "precious");
    EXPECT_NE(RecordingWriter::create(path, scenario, run.states.front()).error().message().find("is there already"),
              std::string::npos);
    EXPECT_EQ(*readFile(path), "precious");
    record();
    EXPECT_TRUE(openRecording(path));
    EXPECT_FALSE(RecordingWriter::create(folder.path(), scenario, run.states.front(), {}, "", {true}));
    EXPECT_FALSE(RecordingWriter::create(folder.path() / "no" / "run.mcap", scenario, run.states.front()));
    EXPECT_FALSE(RecordingWriter::create("/dev/null", scenario, run.states.front(), {}, "", {true}));
}

TEST_F(RecordingFile, TellsWhatRecordedIt) {
    Origin other = thisOrigin();
    other.compiler = "Clang 99";
    other.step = 7;
    const auto recording = openRecording(record({true, 40, other}));
    ASSERT_TRUE(recording);
    EXPECT_EQ(recording->header.origin, other);
    EXPECT_EQ(differences(recording->header.origin, thisOrigin()).size(), 2u);
}

/// Commands drawn anew at every instant, as in the benchmarks' scene: what compresses worst.
class RandomDrive final : public Controller {
public:
    void decide(const Observation& observation, std::span<std::byte>, Decision& decision) const override {
        const NoisePair u = uniformPair({1, observation.time, observation.robot, 0});
        decision.command = Command{u.first, 4 * (2 * u.second - 1)};
    }
};

TEST_F(RecordingFile, AnHourOfEightRobotsTakesAtMost30Megabytes) {
    MatchOptions options;
    options.controller = std::make_shared<const RandomDrive>();
    const Scenario drive(matchParts(options));
    WorldState state = drive.initialState();
    StepBuffers buffers;
    StepTrace trace;
    const std::filesystem::path path = folder.path() / "minutes.mcap";
    auto writer = RecordingWriter::create(path, drive, state);
    ASSERT_TRUE(writer);
    constexpr std::int64_t second = 50, minutes = 4;
    for (std::int64_t i = 1; i <= minutes * 60 * second; ++i) {
        step(drive, state, buffers, {}, &trace);
        writer->add(state, trace);
        if (i % second == 0) writer->flush();  // as a run does that keeps pace with the clock
    }
    ASSERT_TRUE(writer->close());
    EXPECT_LE(std::filesystem::file_size(path) * 60 / minutes, 30'000'000u);
    // Keyframes lie so near to each other that 350 ticks lead anywhere.
    const auto recording = openRecording(path);
    ASSERT_TRUE(recording);
    for (const TimelineBlock& block : recording->branches[0].timeline.blocks()) EXPECT_LE(block.hashes.size(), 350u);
}

TEST(Origin, DifferencesAreSentences) {
    const Origin here = thisOrigin();
    EXPECT_TRUE(differences(here, here).empty());
    EXPECT_FALSE(here.version.empty() || here.compiler.empty() || here.buildType.empty() || here.commit.empty());
    Origin other = here;
    other.version = "0.0.7";
    other.step = 1;
    const std::vector<std::string> sentences = differences(other, here);
    ASSERT_EQ(sentences.size(), 2u);
    EXPECT_EQ(sentences[0], "it was recorded by step 1 of mrose; this is step " + std::to_string(stepVersion) +
                                ": it is exact at its keyframes alone");
    EXPECT_EQ(sentences[1], "it was recorded by mrose 0.0.7; this is " + here.version);
}

}  // namespace
}  // namespace mrose
