// Messages between robots in recordings: exact for going on, and readable.
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "recording/mcap_walk.h"
#include "recording/playback.h"
#include "recording/recording.h"
#include "recording/recording_writer.h"
#include "simulation/radio_world.h"
#include "support/temporary_folder.h"
#include "world/second_state_version.h"
#include "world/state_difference.h"

namespace mrose {
namespace {

using RadioJson = nlohmann::json;

/// Three robots that talk, by a radio that loses, is late and has an end.
class RadioRecording : public testing::Test {
protected:
    static ScenarioParts parts() {
        SmallWorld world;
        world.robot(discRobot(0.2), {0, 0, 0}, announcer(2, 2), everyTicks(5))
            .robot(discRobot(0.2), {2, 0, 0}, announcer(1), everyTicks(3), 1)
            .robot(discRobot(0.2), {4.5, 0, 0}, announcer(3, 0), everyTicks(4), 3);
        world.parts().scene.radio = {.latency = 50'000'000, .jitter = 80'000'000, .loss = 0.2, .range = 3};
        return world.parts();
    }
    void SetUp() override {
        WorldState state = scenario.initialState();
        states.push_back(state);
        auto writer =
            RecordingWriter::create(path, scenario, state, std::make_shared<const ScenarioValue>(), "", {false, 37});
        ASSERT_TRUE(writer) << writer.error().message();
        StepBuffers buffers;
        for (int k = 0; k < 200; ++k) {
            step(scenario, state, buffers, {}, &traces.emplace_back());
            states.push_back(state);
            writer->add(state, traces.back());
        }
        ASSERT_TRUE(writer->close());
    }

    const Scenario scenario{parts()};
    TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "radio.mcap";
    std::vector<WorldState> states;
    std::vector<StepTrace> traces;
};

TEST_F(RadioRecording, EveryTickIsReachedAndGoesOnWithItsMessages) {
    const auto recording = openRecording(path);
    ASSERT_TRUE(recording) << recording.error().message();
    const Timeline& timeline = recording->branches.front().timeline;
    Playback playback(scenario);
    std::size_t onTheirWay = 0;
    for (std::int64_t tick = 0; tick <= 200; ++tick) {
        const auto reached = playback.reach(timeline, tick);
        ASSERT_TRUE(reached) << reached.error().message();
        EXPECT_TRUE(reached->worldSame && reached->memoriesSame);
        const auto difference = firstDifference(states[static_cast<std::size_t>(tick)], reached->state);
        ASSERT_FALSE(difference) << tick << ": " << difference->message();
        onTheirWay += reached->state.messages.size();
    }
    EXPECT_GT(onTheirWay, 200u * 3);
}

/// What the topic says, against observations and decisions.
TEST_F(RadioRecording, OtherProgramsSeeWhoToldWhomWhatAndHowLate) {
    std::set<std::tuple<std::int64_t, std::string, std::int64_t, std::int64_t>> received, expected;
    std::size_t sent = 0, said = 0;
    std::map<std::string, int> outcomes;
    const std::string file = *readFile(path);
    for (const WalkedMessage& message : walkMessages(file)) {
        if (message.topic != "/radio") continue;
        const auto json = RadioJson::parse(message.json);
        const std::int64_t tick = message.time / 20'000'000 - 1;
        sent += json["sent"].size();
        EXPECT_EQ(json["left_out"], 0);
        for (const auto& due : json["due"]) {
            ++outcomes[due["outcome"]];
            const std::int64_t then = std::llround(due["sent_s"].get<double>() * 50);
            EXPECT_NEAR(due["late_ms"], 20.0 * static_cast<double>(tick - then), 0.06);
            EXPECT_GE(due["arrival_ms"], 50);
            EXPECT_LE(due["arrival_ms"], 130);
            EXPECT_EQ(due["size"], 8);
            // The time of sending, ns, from its lowest byte on.
            std::int64_t bytes = 0;
            const std::string text = due["bytes"];
            for (int i = 7; i >= 0; --i)
                bytes = bytes << 8 | std::stoi(text.substr(2 * static_cast<std::size_t>(i), 2), nullptr, 16);
            EXPECT_EQ(bytes, then * 20'000'000);
            if (due["outcome"] == "received")
                received.insert({tick, std::string(due["from"]) + '>' + std::string(due["to"]), then, due["kind"]});
        }
    }
    for (std::size_t k = 0; k < traces.size(); ++k)
        for (std::size_t robot = 0; robot < 3; ++robot) {
            const StepTrace::Robot& traced = traces[k].robots[robot];
            if (!traced.decided) continue;
            said += traced.decision.messages.size();
            for (const ReceivedMessage& m : traced.observation.messages())
                expected.insert({static_cast<std::int64_t>(k),
                                 std::to_string(m.from + 1) + '>' + std::to_string(robot + 1), m.sent / 20'000'000,
                                 m.kind});
        }
    EXPECT_EQ(received, expected);
    EXPECT_EQ(sent, said);
    EXPECT_GT(outcomes["lost"], 10);
    EXPECT_GT(outcomes["out of range"], 10) << "the outer two are 4.5 m apart";
}

/// Hashes of version 2 are those of a recording that was begun before messages had a place.
TEST_F(RadioRecording, BlocksWithHashesOfVersion2AreExactToo) {
    TimelineBlock block;
    block.first = 99;
    block.hashes = {secondVersionHash(states[100])};
    ASSERT_FALSE(states[100].messages.empty());
    ASSERT_NE(block.hashes[0].world, hashOf(states[100]).world);
    EXPECT_TRUE(block.compare(scenario, states[100]).world);
    WorldState other = states[100];
    other.messages.back().bytes[0] ^= std::byte{1};
    EXPECT_FALSE(block.compare(scenario, other).world);
}

}  // namespace
}  // namespace mrose
