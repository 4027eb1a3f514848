// Recordings from before scenarios were values: the texts of their descriptions, and a batch's trial.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/bytes.h"
#include "io/compression.h"
#include "io/file.h"
#include "recording/branch_scenario.h"
#include "recording/mcap_walk.h"
#include "recording/playback.h"
#include "recording/replay.h"
#include "scenario/descriptions.h"
#include "support/places.h"

namespace mrose {
namespace {

/// `mrose run game.toml --trial 5 --record format_1.mcap` of a rover that chases a ball and one that wanders, 4 s, by
/// the last version that wrote format 1, whose step was 1.
class OldRecording : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(recording) << recording.error().message();
        auto parts = recordedScenario(*recording, 0, [](const std::string&, const std::string&) {
            return Expected<std::shared_ptr<const Controller>>(nullptr);
        });
        ASSERT_TRUE(parts) << parts.error().message();
        scenario = std::make_shared<const Scenario>(std::move(*parts));
    }

    const std::filesystem::path path = sourceFolder() / "tests/recording/data/format_1.mcap";
    const Expected<Recording> recording = openRecording(path);
    std::shared_ptr<const Scenario> scenario;
};

TEST_F(OldRecording, OpensAndSaysItsStep) {
    EXPECT_TRUE(recording->damage.empty());
    ASSERT_TRUE(recording->header.value) << recording->header.unknown->message();
    EXPECT_EQ(recording->header.value->bodyPath("two"), "robot[2]");
    EXPECT_TRUE(recording->header.value->at("robot[1].start.heading_rad")) << "where the trial put it";
    EXPECT_EQ(recording->header.origin.step, 1);
    const std::vector<std::string> sentences = differences(recording->header.origin, thisOrigin());
    ASSERT_FALSE(sentences.empty());
    EXPECT_TRUE(sentences[0].starts_with("it was recorded by step 1 of mrose; this is step ")) << sentences[0];
}

/// By the recorded decisions, and also where the controllers decide again, all go nearly where the messages for other
/// programs say: this step draws another motion noise, and once a rover touches the ball it solves contacts otherwise.
TEST_F(OldRecording, GoesWhereItWent) {
    const Timeline& timeline = recording->branches.front().timeline;
    ASSERT_EQ(timeline.last(), 200);
    const auto start = Playback(*scenario).reach(timeline, 0);
    ASSERT_TRUE(start) << start.error().message();
    WorldState decided = start->state;
    StepBuffers buffers;
    constexpr std::int64_t firstTouch = 116;
    int compared = 0;
    const std::string file = readFile(path).value();
    for (const WalkedMessage& message : walkMessages(file)) {
        if (message.topic != "/bodies") continue;
        const std::int64_t tick = message.time / scenario->scene().tickLength;
        while (decided.tick < tick) step(*scenario, decided, buffers);
        const auto played = Playback(*scenario).reach(timeline, tick);
        ASSERT_TRUE(played) << played.error().message();
        const auto bodies = nlohmann::json::parse(message.json);
        const double allowed = tick < firstTouch ? 0.005 : 0.02;
        for (const WorldState* const state : {&played->state, static_cast<const WorldState*>(&decided)}) {
            const std::pair<const char*, Pose> reached[] = {
                {"one", state->robots[0].pose}, {"two", state->robots[1].pose}, {"ball", state->objects[0].pose}};
            for (const auto& [name, pose] : reached) {
                EXPECT_NEAR(pose.x, bodies[name]["x"], allowed) << name << " at tick " << tick;
                EXPECT_NEAR(pose.y, bodies[name]["y"], allowed) << name << " at tick " << tick;
            }
        }
        ++compared;
    }
    EXPECT_EQ(compared, 41);
}

TEST(OldBranch, BranchThatWasToldByTextsIsOfItsOwn) {
    const KeptTexts run = smallWorld();
    std::string bytes, changed = run.at("s.toml");
    changed.replace(changed.find("seed = 7"), 8, "seed = 8");
    appendNumber(bytes, std::uint32_t{1});
    appendNumber(bytes, std::uint32_t{4});
    appendNumber(bytes, Nanoseconds{20'000'000});
    appendNumber(bytes, std::uint64_t{1});
    appendNumber(bytes, std::uint64_t{16});
    appendNumber(bytes, std::uint64_t{2});
    appendLong(bytes, "s.toml");
    appendNumber(bytes, std::uint64_t{run.size()});
    for (const auto& [name, text] : run) {
        const bool own = name == "s.toml";
        appendLong(bytes, name);
        appendNumber(bytes, static_cast<std::uint8_t>(own));
        if (own) appendLong(bytes, changed);
    }
    const auto branch = parseBranchScenario(compressed(bytes), nullptr, run);
    ASSERT_TRUE(branch);
    EXPECT_EQ(branch->branch, 4u);
    EXPECT_EQ(branch->layout.controllers, (std::vector<RecordingHeader::ControllerNeeds>{{16, 2}}));
    EXPECT_EQ(*branch->value, loadFrom(changedWorld("s.toml", "seed = 7", "seed = 8"))->value);
    EXPECT_FALSE(parseBranchScenario(compressed(bytes), nullptr, {})) << "the run has not the others";
    EXPECT_FALSE(parseBranchScenario(compressed(bytes + 'x'), nullptr, run));
}

}  // namespace
}  // namespace mrose
