#include "recording/recording.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "recording/match.h"
#include "recording/mcap_walk.h"
#include "recording/playback.h"
#include "recording/recording_writer.h"
#include "support/temporary_folder.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

constexpr std::int64_t ticks = 230;

class RecordingFile : public testing::Test {
protected:
    /// Records a run, flushed at some ticks, with a branch.
    std::filesystem::path record(const RecordingWriter::Options& options = {true, 40}) {
        const std::filesystem::path path = folder.path() / "run.mcap";
        auto writer = RecordingWriter::create(path, scenario, run.states.front(), descriptions, "mrose run x", options);
        EXPECT_TRUE(writer) << writer.error().message();
        for (std::size_t i = 0; i < run.traces.size(); ++i) {
            writer->add(run.states[i + 1], run.traces[i]);
            if (i == 17 || i == 18 || i == 100) writer->flush();
            if (i == 120) {
                EXPECT_EQ(writer->beginBranch(0, branchRun.states.front(), "pushed"), 1u);
                for (std::size_t k = 0; k < branchRun.traces.size(); ++k)
                    writer->add(branchRun.states[k + 1], branchRun.traces[k], 1);
            }
        }
        writer->keep(run.states.back());
        const auto closed = writer->close();
        EXPECT_TRUE(closed) << closed.error().message();
        return path;
    }

    static WorldState pushed(WorldState state) {
        state.objects[0].velocity_W.y -= 1.5;
        return state;
    }

    TemporaryFolder folder;
    Scenario scenario{matchParts()};
    StraightRun run = runMatch(scenario, scenario.initialState(), ticks);
    StraightRun branchRun = runMatch(scenario, pushed(run.states[90]), 60);
    Descriptions descriptions{"soccer.toml",
                              {{"soccer.toml", "seed = 1\n"}, {"shapes/ball \"x\".toml", std::string("\0\n", 2)}}};
};

void expectStates(const Scenario& scenario, const Timeline& timeline, const StraightRun& run) {
    Playback playback(scenario);
    const std::int64_t start = run.states.front().tick;
    EXPECT_EQ(timeline.first(), start);
    for (std::int64_t tick = timeline.first(); tick <= timeline.last(); ++tick) {
        const auto reached = playback.reach(timeline, tick);
        ASSERT_TRUE(reached) << reached.error().message();
        EXPECT_TRUE(reached->worldSame && reached->mindsSame);
        const auto difference = firstDifference(run.states[static_cast<std::size_t>(tick - start)], reached->state);
        ASSERT_FALSE(difference) << tick << ": " << difference->message();
    }
}

TEST_F(RecordingFile, ComesBackToTheBit) {
    const auto recording = openRecording(record());
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->damage.empty()) << recording->damage.front();
    const RecordingHeader& header = recording->header;
    EXPECT_EQ(header.descriptions, descriptions);
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
    expectStates(scenario, recording->branches[0].timeline, run);
    expectStates(scenario, recording->branches[1].timeline, branchRun);
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
    EXPECT_NE(damageAfter(9, 2, 100).find("is a recording without a beginning: the attachment"), std::string::npos);
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
    EXPECT_NE(openRecording(folder.path() / "newer.mcap").error().message().find("format 9; expected 1"),
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

// What other programs see. ------------------------------------------------------------------------------------------

TEST_F(RecordingFile, OtherProgramsSeeWhereBodiesAre) {
    const std::string file = *readFile(record());
    std::size_t samples = 0;
    for (const WalkedMessage& message : walkMessages(file)) {
        const auto json = nlohmann::json::parse(message.json);
        const bool branch = message.topic.starts_with("/branch_1/");
        if (message.topic != "/tf" && message.topic != "/branch_1/tf") continue;
        ++samples;
        const std::int64_t tick = message.time / 20'000'000;
        const WorldState& state =
            branch ? branchRun.states[static_cast<std::size_t>(tick - 90)] : run.states[static_cast<std::size_t>(tick)];
        ASSERT_EQ(json["transforms"].size(), 10u);
        for (std::size_t body = 0; body < 10; ++body) {
            const auto& transform = json["transforms"][body];
            const Pose& pose = Scenario::poseOf(state, body);
            EXPECT_NEAR(transform["translation"]["x"], pose.x, 5.1e-5);
            EXPECT_NEAR(transform["translation"]["y"], pose.y, 5.1e-5);
            const double heading =
                2 * std::atan2(transform["rotation"]["z"].get<double>(), transform["rotation"]["w"].get<double>());
            EXPECT_NEAR(std::remainder(heading - pose.heading, 2 * std::acos(-1.0)), 0, 2e-5);
            EXPECT_EQ(transform["parent_frame_id"], "world");
            const std::string frame = body < 8 ? "rover_" + std::to_string(body + 1) : body == 8 ? "ball" : "crate";
            EXPECT_EQ(transform["child_frame_id"], (branch ? "branch_1/" : "") + frame);
            EXPECT_EQ(transform["timestamp"]["sec"], message.time / 1'000'000'000);
            EXPECT_EQ(transform["timestamp"]["nsec"], message.time % 1'000'000'000);
        }
    }
    EXPECT_EQ(samples, ticks / 5 + 1 + 60 / 5 + 1);
}

TEST_F(RecordingFile, OtherProgramsSeeCommandsContactsAndScene) {
    double pressed = 0, told = 0;
    for (std::size_t i = 0; i < 5 * (ticks / 5); ++i)
        for (const ContactReport& contact : run.traces[i].contacts) pressed += contact.impulse;
    std::size_t kicks = 0, kicksTold = 0, scenes = 0;
    for (const StepTrace& trace : run.traces) kicks += trace.kicks.size();
    ASSERT_GT(pressed, 0);
    for (const WalkedMessage& message : walkMessages(*readFile(record()))) {
        const auto json = nlohmann::json::parse(message.json);
        if (message.topic == "/contacts") {
            double sum = 0;
            for (const auto& contact : json["contacts"]) sum += contact["impulse"].get<double>();
            EXPECT_NEAR(sum, json["impulse"], 0.02);
            EXPECT_EQ(json["contacts"].size(), json["count"]);
            told += json["impulse"].get<double>();
        }
        if (message.topic == "/robots") {
            const std::int64_t tick = message.time / 20'000'000;
            const WorldState& state = run.states[static_cast<std::size_t>(tick)];
            const auto& third = json["rover_3"];
            EXPECT_NEAR(third["v"], state.robots[2].velocity_B.x, 5.1e-5);
            EXPECT_NEAR(third["w"], state.robots[2].velocity_B.rotation, 5.1e-5);
            EXPECT_NEAR(third["heading"], state.robots[2].pose.heading, 5.1e-5);
            EXPECT_NEAR(third["w_command"], scenario.commandsOf(state, 2).at(message.time).w, 5.1e-5);
        }
        if (message.topic == "/log") kicksTold += json["message"].get<std::string>().find("kicks") != std::string::npos;
        if (message.topic == "/scene") {
            ++scenes;
            ASSERT_EQ(json["entities"].size(), 11u);
            EXPECT_EQ(json["entities"][0]["frame_id"], "world");
            EXPECT_EQ(json["entities"][0]["lines"].size(), 4u);
            EXPECT_EQ(json["entities"][1]["frame_id"], "rover_1");
            EXPECT_EQ(json["entities"][1]["triangles"].size(), 1u);
            EXPECT_EQ(json["entities"][2]["cylinders"][0]["size"]["x"], 0.45);
            EXPECT_EQ(json["entities"][9]["spheres"][0]["size"]["z"], 0.22);
        }
    }
    EXPECT_NEAR(told, pressed, 1e-3 * ticks);
    EXPECT_EQ(kicksTold, kicks);
    EXPECT_EQ(scenes, 1u);
}

TEST(Origin, DifferencesAreSentences) {
    const Origin here = thisOrigin();
    EXPECT_TRUE(differences(here, here).empty());
    EXPECT_FALSE(here.version.empty() || here.compiler.empty() || here.buildType.empty() || here.commit.empty());
    Origin other = here;
    other.version = "0.0.7";
    other.instructionSets = "sse4.1";
    const std::vector<std::string> sentences = differences(other, here);
    ASSERT_EQ(sentences.size(), 2u);
    EXPECT_EQ(sentences[0], "it was recorded by mrose 0.0.7; this is " + here.version);
    EXPECT_EQ(sentences[1], "it was recorded with the instruction sets sse4.1; this is " + here.instructionSets);
}

}  // namespace
}  // namespace mrose
