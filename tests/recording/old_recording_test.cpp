// Recordings from before scenarios were values: the texts of their descriptions, and a batch's trial.
#include <gtest/gtest.h>

#include "io/bytes.h"
#include "io/compression.h"
#include "recording/branch_scenario.h"
#include "recording/replay.h"
#include "scenario/descriptions.h"
#include "support/places.h"

namespace mrose {
namespace {

/// `mrose run game.toml --trial 5 --record format_1.mcap` of a rover that chases a ball and one that wanders, 4 s, by
/// the last version that wrote format 1.
TEST(OldRecording, OpensAndDecidesAgainAsItDid) {
    const auto recording = openRecording(sourceFolder() / "tests/recording/data/format_1.mcap");
    ASSERT_TRUE(recording) << recording.error().message();
    EXPECT_TRUE(recording->damage.empty());
    ASSERT_TRUE(recording->header.value) << recording->header.unknown->message();
    EXPECT_EQ(recording->header.value->bodyPath("two"), "robot[2]");
    EXPECT_TRUE(recording->header.value->at("robot[1].start.heading_rad")) << "where the trial put it";
    auto parts = recordedScenario(*recording, 0, [](const std::string&, const std::string&) {
        return Expected<std::shared_ptr<const Controller>>(nullptr);
    });
    ASSERT_TRUE(parts) << parts.error().message();
    const auto scenario = std::make_shared<const Scenario>(std::move(*parts));
    const auto report = replay(recording->branches, std::vector{scenario}, {true, {}});
    ASSERT_TRUE(report) << report.error().message();
    EXPECT_FALSE(report->difference) << report->difference->what;
    EXPECT_EQ(report->ticks, 200);
}

TEST(OldRecording, BranchThatWasToldByTextsIsOfItsOwn) {
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
