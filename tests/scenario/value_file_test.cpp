#include "scenario/value_file.h"

#include <gtest/gtest.h>

#include "scenario/descriptions.h"
#include "scenario/saved_state.h"
#include "simulation/step.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

TEST(ValueFile, IsAScenarioByItself) {
    const auto loaded = loadFrom(smallWorld());
    const std::string text = valueFileText(loaded->value);
    const auto again = loadFrom({{"all.value", text}}, "all.value");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->value, loaded->value);
    EXPECT_EQ(hashOf(stateAfter(again->parts, 200)), hashOf(stateAfter(loaded->parts, 200)));
}

TEST(ValueFile, StateFileGoesOnByItself) {
    const auto loaded = loadFrom(smallWorld());
    const Scenario scenario(loaded->parts);
    WorldState state = stateAfter(loaded->parts, 120);
    const std::string text = savedStateText(savedState(scenario, state), &loaded->value);
    const auto again = loadFrom({{"x.state", text}}, "x.state");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(hashOf(Scenario(again->parts).initialState()), hashOf(state));
    const auto alone = loadFrom({{"x.state", savedStateText(savedState(scenario, state))}}, "x.state");
    EXPECT_EQ(alone.error().message(),
              "x.state: does not hold the scenario that it is a state of; expected one whose initial_state it is");
}

TEST(ValueFile, DamageIsNamed) {
    const std::string text = valueFileText(loadFrom(smallWorld())->value);
    const auto refused = [](std::string wrong) {
        const auto loaded = loadFrom({{"f", std::move(wrong)}}, "f");
        return loaded ? std::string() : loaded.error().message();
    };
    std::string wrong = text;
    wrong[wrong.size() / 2] ^= 1;
    EXPECT_TRUE(refused(wrong).ends_with("value: is damaged")) << refused(wrong);
    EXPECT_NE(refused(text + "x = 1\n").find("x: is not a known key"), std::string::npos);
    wrong = text;
    wrong.replace(wrong.find("version = 1"), 11, "version = 2");
    EXPECT_NE(refused(wrong).find("version: expected a whole number from 1 to 1"), std::string::npos);
}

}  // namespace
}  // namespace mrose
