#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/motion_network.h"
#include "motion/network_fixture.h"

namespace mrose {
namespace {

using Form = MotionNetwork::Form;

TEST(NetworkFile, ReadsBackEveryBitOfBothForms) {
    for (const Form form : {Form::state, Form::history}) {
        MotionNetwork network = arbitraryNetwork(form);
        if (form == Form::state) network.drive = DifferentialDrive{0.1651, 1.23};
        const auto read = parseNetwork(networkText(network), "n.net");
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_TRUE(*read == network);
        EXPECT_EQ(networkText(*read), networkText(network));
    }
}

TEST(NetworkFile, TellsWhichGroupsWereHeldOutOnlyWhereSomeWere) {
    MotionNetwork network = arbitraryNetwork(Form::state);
    EXPECT_THAT(networkText(network), testing::Not(testing::HasSubstr("groups")));
    network.heldOut.groups = {5, 3};
    const auto read = parseNetwork(networkText(network), "n.net");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_TRUE(*read == network);
}

/// The error of a file in which `from` was replaced by `to`.
std::string errorAfter(const std::string& from, const std::string& to, Form form = Form::history) {
    std::string text = networkText(arbitraryNetwork(form));
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const auto read = parseNetwork(text, "n.net");
    return read ? "no error" : read.error().message();
}

TEST(NetworkFile, NamesFileLineAndKeyOfWhatDoesNotFit) {
    EXPECT_THAT(errorAfter("\"mrose motion network\"", "\"poem\""), testing::MatchesRegex("n.net:2:.*format.*poem.*"));
    EXPECT_THAT(errorAfter("version = 1", "version = 2"), testing::MatchesRegex("n.net:3:.*version.*"));
    EXPECT_THAT(errorAfter("form = \"history\"", "form = \"recurrent\""), testing::HasSubstr("form: is \"recurrent\""));
    EXPECT_THAT(errorAfter("period_s = 0.1", "period_s = 0.0"), testing::HasSubstr("period_s"));
    EXPECT_THAT(errorAfter("period_s = 0.1", "period_s = \"fast\""), testing::HasSubstr("period_s"));
    EXPECT_THAT(errorAfter("period_s = 0.1", "period_s = nan"), testing::HasSubstr("period_s"));
    EXPECT_THAT(errorAfter("period_s = 0.1\n", ""), testing::HasSubstr("period_s: is missing"));
    EXPECT_THAT(errorAfter("period_s = 0.1\n", "period_s = 0.1\nperiod_ms = 100\n"),
                testing::HasSubstr("period_ms: is not a known key"));
    EXPECT_THAT(errorAfter("hidden = 13", "hidden = 12"), testing::HasSubstr("layers.hidden_weights"));
    EXPECT_THAT(errorAfter("hidden = 13", "hidden = 999999999999"), testing::HasSubstr("hidden"));
    EXPECT_THAT(errorAfter("command_v", "command_u"), testing::HasSubstr("inputs[4].quantity"));
    EXPECT_THAT(errorAfter("robot = \"b\"", "robot = \"z\""), testing::HasSubstr("inputs[3].robot"));
    EXPECT_THAT(errorAfter("oldest_s = 0.04", "oldest_s = 0.0"), testing::HasSubstr("oldest_s"));
    EXPECT_THAT(errorAfter("name = \"dx_m\"", "name = \"dz_m\""), testing::HasSubstr("outputs[\"dz_m\"].name"));
    EXPECT_THAT(errorAfter("[recovery]", "[recovery_]"), testing::HasSubstr("recovery"));
    EXPECT_THAT(errorAfter("quantum_mps = 0.0084", "quantum_mps = 0"), testing::HasSubstr("wheel_phase.quantum_mps"));
    EXPECT_THAT(errorAfter("hidden_biases = [", "hidden_biases = [1.0, "), testing::HasSubstr("layers.hidden_biases"));
    EXPECT_THAT(errorAfter("hidden_biases = [", "hidden_biases = [\"1\", "),
                testing::HasSubstr("layers.hidden_biases"));
    EXPECT_THAT(errorAfter("[held_out]", "[held_in]"), testing::HasSubstr("held_out: is missing"));
}

TEST(NetworkFile, HeldOutGroupsMustBeARule) {
    const auto errorOf = [](const std::string& groups) {
        return errorAfter("heading_percent = 3.89", "heading_percent = 3.89\ngroups = " + groups);
    };
    EXPECT_EQ(errorOf("{ every = 5, offset = 4 }"), "no error");
    EXPECT_THAT(errorOf("{ every = 1, offset = 0 }"), testing::HasSubstr("held_out.groups.every"));
    EXPECT_THAT(errorOf("{ every = 5, offset = 5 }"), testing::HasSubstr("held_out.groups.offset: expected less"));
    EXPECT_THAT(errorOf("{ every = 5, offset = -1 }"), testing::HasSubstr("held_out.groups.offset"));
    EXPECT_THAT(errorOf("{ every = 5 }"), testing::HasSubstr("held_out.groups.offset: is missing"));
    EXPECT_THAT(errorOf("{ every = 5, offset = 4, share = 0.2 }"), testing::HasSubstr("held_out.groups.share"));
    EXPECT_THAT(errorOf("\"group % 5\""), testing::HasSubstr("held_out.groups"));
}

TEST(NetworkFile, StateFormNeedsFiveOutputs) {
    EXPECT_THAT(errorAfter("form = \"history\"", "form = \"state\""), testing::HasSubstr("outputs"));
}

TEST(NetworkFile, TruncatedAnywhereIsAnError) {
    const std::string text = networkText(arbitraryNetwork(Form::history));
    for (std::size_t length = 0; length + 2 < text.size(); length += 97)
        EXPECT_FALSE(parseNetwork(text.substr(0, length), "n.net")) << length;
}

TEST(NetworkFile, NotTomlAtAllIsAnErrorWithItsPlace) {
    for (const char* text : {"[=", "\xff\xfe", "a = \n", "\n\nformat = \"mrose motion network"}) {
        const auto read = parseNetwork(text, "n.net");
        ASSERT_FALSE(read);
        EXPECT_THAT(read.error().message(), testing::MatchesRegex("n.net:[0-9]+:[0-9]+: is not TOML.*"));
    }
}

TEST(NetworkFile, TextsWithControlCharactersComeBack) {
    MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::state);
    network.training.command = "mrose train 'a\nb\t\x01\x7f' \\ \"ä\"";
    const auto read = parseNetwork(networkText(network), "n.net");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->training.command, network.training.command);
}

TEST(NetworkFile, WeightsBeyondFloatsAreRefused) {
    std::string text = networkText(arbitraryNetwork(MotionNetwork::Form::state));
    const auto at = text.find("output_biases = [") + 17;
    text.replace(at, text.find(',', at) - at, "4e38");
    const auto read = parseNetwork(text, "n.net");
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message(), testing::HasSubstr("layers.output_biases: is 4e+38; expected"));
}

TEST(NetworkFile, MissingFileIsAnError) {
    const auto read = loadNetwork("no/such/file.net");
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message(), testing::HasSubstr("no/such/file.net: cannot be read"));
}

}  // namespace
}  // namespace mrose
