// What scenario files say of the radio and of teams.
#include <gtest/gtest.h>

#include "scenario/descriptions.h"

namespace mrose {
namespace {

constexpr const char* seed = "seed = 7";

Expected<LoadedScenario> withRadio(const std::string& radio) {
    return loadFrom(changedWorld("s.toml", seed, seed + ("\nradio = { " + radio + " }")));
}

TEST(RadioFile, SaysAllOfTheRadio) {
    const auto loaded = withRadio("latency_s = 0.125, jitter_s = 1, loss = 0.25, range_m = 12.5, message_bytes = 33");
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Radio expected{125'000'000, 1'000'000'000, 0.25, 12.5, 33};
    EXPECT_EQ(loaded->parts.scene.radio, expected);
    const auto again = ScenarioValue::parse(loaded->value.bytes());
    ASSERT_TRUE(again);
    const auto back = loadScenario(*again);
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_EQ(back->parts.scene.radio, expected) << "the value holds it";
    const auto other = loaded->value.with("radio.loss", Value(0.5));
    ASSERT_TRUE(other);
    EXPECT_EQ(loadScenario(*other)->parts.scene.radio.loss, 0.5);
}

TEST(RadioFile, WithoutItMessagesArriveAtOnceEverywhere) {
    for (const auto& loaded : {loadFrom(smallWorld()), withRadio("")}) {
        ASSERT_TRUE(loaded) << loaded.error().message();
        EXPECT_EQ(loaded->parts.scene.radio, Radio{});
        for (const std::uint32_t team : teamsOf(loaded->parts.scene)) EXPECT_EQ(team, 0u);
    }
}

TEST(RadioFile, MistakesNameTheirPlace) {
    const std::pair<const char*, const char*> cases[] = {
        {"latency_s = -0.1", "s.toml:6:23: radio.latency_s: is -0.1; expected 0.0 to 1.0"},
        {"latency_s = 1.5", "s.toml:6:23: radio.latency_s: is 1.5; expected 0.0 to 1.0"},
        {"jitter_s = -1", "s.toml:6:22: radio.jitter_s: is -1.0; expected 0.0 to 1.0"},
        {"loss = 1.01", "s.toml:6:18: radio.loss: is 1.01; expected 0.0 to 1.0"},
        {"loss = -0.5", "s.toml:6:18: radio.loss: is -0.5; expected 0.0 to 1.0"},
        {"range_m = -2", "s.toml:6:21: radio.range_m: is -2.0; expected 0.0 to 1000000.0"},
        {"message_bytes = 129", "s.toml:6:27: radio.message_bytes: expected a whole number from 1 to 128"},
        {"message_bytes = 0", "s.toml:6:27: radio.message_bytes: expected a whole number from 1 to 128"},
        {"message_bytes = 8.5", "s.toml:6:27: radio.message_bytes: expected a whole number from 1 to 128"},
        {"latency = 0.1", "s.toml:6:21: radio.latency: is not a known key; did you mean latency_s?"}};
    for (const auto& [radio, message] : cases) {
        const auto loaded = withRadio(radio);
        ASSERT_FALSE(loaded) << radio;
        EXPECT_EQ(loaded.error().message(), message);
    }
    EXPECT_EQ(refusal("s.toml", seed, "seed = 7\nradio = 3"), "s.toml:6:9: radio: expected a table");
}

/// In the small world robots one and two and the person three.
TEST(RadioFile, TeamsAreOfRobotsAndPeople) {
    auto texts = changedWorld("s.toml", "name = \"one\"", "name = \"one\"\nteam = \"red\"");
    const std::string three = "name = \"three\"";
    std::string& text = texts.at("s.toml");
    text.insert(text.find(three) + three.size(), "\nteam = \"red\"");
    const auto loaded = loadFrom(texts);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->parts.scene.robots[2].team, "red");
    const std::vector<std::uint32_t> expected{0, noTeam, 0};
    EXPECT_EQ(teamsOf(loaded->parts.scene), expected);
}

TEST(RadioFile, ATeamOfOneIsAMistake) {
    EXPECT_EQ(
        refusal("s.toml", "name = \"two\"", "name = \"two\"\nteam = \"blue\""),
        "s.toml:18:8: robot[\"two\"].team: no other robot is of team \"blue\"; expected one to talk to, or no team");
    EXPECT_EQ(refusal("s.toml", "name = \"two\"", "name = \"two\"\nteam = \"\""),
              "s.toml:18:8: robot[\"two\"].team: expected a name of 1 to 64 printable characters");
}

}  // namespace
}  // namespace mrose
