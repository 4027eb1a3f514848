// Files of the first version, which recordings and users keep, are read as they were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file.h"
#include "motion/learned_model.h"
#include "support/places.h"

namespace mrose {
namespace {

const std::filesystem::path firstFiles = sourceFolder() / "tests" / "fuzz" / "corpus" / "network";

TEST(FirstNetworkVersion, IsReadWholly) {
    const auto network = loadNetwork(firstFiles / "first_history.net");
    ASSERT_TRUE(network) << network.error().message();
    EXPECT_EQ(network->form, MotionNetwork::Form::history);
    EXPECT_EQ(network->robotType, "test \"robot\" \\ 1");
    EXPECT_EQ(network->robots, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(network->period, 100'000'000);
    EXPECT_EQ(network->turnOffset, 0.0055);
    EXPECT_TRUE((network->wheelPhase == MotionNetwork::WheelPhase{0.13, 0.0084}));
    EXPECT_TRUE((network->recovery == MotionNetwork::Recovery{0.1, 0.14}));
    ASSERT_EQ(network->inputs.size(), 6u);
    EXPECT_EQ(network->inputs[2].robot, "b");
    EXPECT_EQ(network->inputs[4].oldest, 0.225);
    EXPECT_EQ(network->inputs[4].scale, 0.22);
    ASSERT_EQ(network->outputs.size(), 7u);
    EXPECT_EQ(network->outputs[4].mean, 0.004);
    EXPECT_EQ(network->outputs[4].scale, 0.05);
    EXPECT_TRUE((network->mlp.shape == MlpShape{6, 2, 7}));
    EXPECT_EQ(network->mlp.parameters.size(), network->mlp.shape.parameterCount());
    EXPECT_TRUE(network->members.empty()) << "they were not written";
    EXPECT_EQ(network->training.seed, 7u);
    EXPECT_EQ(network->training.logs.at(0).hash, "0123456789abcdef");
    EXPECT_EQ(network->heldOut.windows, 321);
    EXPECT_EQ(network->heldOut.position, 1.66);
    ASSERT_EQ(network->identified.size(), 1u);
    EXPECT_EQ(network->identified[0].dynamic.w.gain, 0.98);
}

TEST(FirstNetworkVersion, IsWrittenAsTheNewOneWithoutLosingABit) {
    for (const char* file : {"first_history.net", "first_state.net"}) {
        const auto first = loadNetwork(firstFiles / file);
        ASSERT_TRUE(first) << first.error().message();
        const auto again = parseNetwork(networkText(*first), file);
        ASSERT_TRUE(again) << again.error().message();
        EXPECT_TRUE(*again == *first) << file;
    }
}

TEST(FirstNetworkVersion, KeepsItsStrictness) {
    const auto text = readFile(firstFiles / "first_history.net");
    ASSERT_TRUE(text);
    const auto errorAfter = [&](const std::string& from, const std::string& to) {
        std::string changed = *text;
        const std::size_t at = changed.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        changed.replace(at, from.size(), to);
        const auto read = parseNetwork(changed, "n.net");
        return read ? "no error" : read.error().message();
    };
    EXPECT_THAT(errorAfter("version = 1", "version = 2"), testing::MatchesRegex("n.net:3:.*version.*"));
    EXPECT_THAT(errorAfter("period_s = 0.1\n", "period_s = 0.1\nperiod_ms = 100\n"),
                testing::HasSubstr("period_ms: is not a known key"));
    EXPECT_THAT(errorAfter("name = \"dx_m\"", "name = \"dx\""), testing::HasSubstr("outputs[\"dx\"].name"));
    EXPECT_THAT(errorAfter("oldest_s = 0.04", "oldest_s = 0.0"), testing::HasSubstr("inputs[4].oldest_s"));
    EXPECT_THAT(errorAfter("[recovery]", "[recovery_]"), testing::HasSubstr("recovery"));
    EXPECT_THAT(errorAfter("heading_percent = 3.89", "heading_percent = 3.89\ngroups = { every = 5, offset = 5 }"),
                testing::HasSubstr("held_out.groups.offset: expected less"));
    EXPECT_EQ(errorAfter("heading_percent = 3.89", "heading_percent = 3.89\ngroups = { every = 5, offset = 4 }"),
              "no error");
}

}  // namespace
}  // namespace mrose
