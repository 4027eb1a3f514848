#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/motion_network.h"
#include "motion/network_fixture.h"

namespace mrose {
namespace {

using Form = MotionNetwork::Form;

FamiliarDriving arbitraryFamiliar() {
    FamiliarDriving familiar;
    familiar.v = {0.04, 0.44, 0.0712345678901234};
    familiar.w = {0.05, 0.25, 0.3};
    familiar.prototypes = {{1, 0.1, -0.25, 3e-3, 0, 1.0 / 3}, {-1, 2, 3, 4, 5, 6}};
    familiar.distances = {0.5, 0.7, 1.1};
    familiar.periods = 4321;
    return familiar;
}

TEST(NetworkFile, ReadsBackEveryBitOfBothForms) {
    for (const Form form : {Form::state, Form::history}) {
        MotionNetwork network = arbitraryNetwork(form);
        if (form == Form::state) network.drive = DifferentialDrive{0.1651, 1.23};
        if (form == Form::history) network.familiar = arbitraryFamiliar();
        const auto read = parseNetwork(networkText(network), "n.net");
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_TRUE(*read == network);
        EXPECT_EQ(networkText(*read), networkText(network));
    }
}

TEST(NetworkFile, KeepsAnyOfTheLimitsOfADrive) {
    for (const ActuatorLimits& limits : {ActuatorLimits{0.5, 0, 0, 0}, {0, 5, 0, 0}, {0, 0, 0.5, 0.2}, {}}) {
        MotionNetwork network = arbitraryNetwork(Form::state);
        network.limits = limits;
        const auto read = parseNetwork(networkText(network), "n.net");
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->limits, limits);
    }
}

TEST(NetworkFile, KeepsTheMembersOfAnEnsemble) {
    MotionNetwork network = arbitraryNetwork(Form::history);
    std::vector<float>& p = network.mlp.parameters;
    network.members = {{8, {0.1f, 0.2f, 0.3f}}, {5, {0.3f, -0.2f, 0.7f}}};
    for (std::size_t k = 0; k < 3; ++k)
        p[p.size() - 7 + k] = network.members[0].outputBiases[k] / 2 + network.members[1].outputBiases[k] / 2;
    const auto read = parseNetwork(networkText(network), "n.net");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_TRUE(*read == network);
}

TEST(NetworkFile, TellsWhichGroupsWereHeldOutOnlyWhereSomeWere) {
    MotionNetwork network = arbitraryNetwork(Form::state);
    EXPECT_THAT(networkText(network), testing::Not(testing::HasSubstr("groups")));
    network.heldOut.part = {5, 3};
    const auto read = parseNetwork(networkText(network), "n.net");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_TRUE(*read == network);
}

TEST(NetworkFile, SaysOfEachVariableWhatItIsAndInWhatUnit) {
    const std::string text = networkText(arbitraryNetwork(Form::history));
    EXPECT_THAT(text, testing::HasSubstr("{ name = \"velocity_v\", unit = \"m/s\", mean = 0.0, scale = 0.1 }"));
    EXPECT_THAT(text, testing::HasSubstr("{ name = \"robot b\", unit = \"1\", "));
    EXPECT_THAT(text, testing::HasSubstr("{ name = \"command_w 0.1 to 0.225 s before\", unit = \"rad/s\", "));
    EXPECT_THAT(text, testing::HasSubstr("{ name = \"start_w\", unit = \"rad/s\", "));
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
    EXPECT_THAT(errorAfter("form = \"history\"", "form = \"recurrent\""),
                testing::MatchesRegex("n.net:[0-9]+:[0-9]+: motion.form: is \"recurrent\".*"));
    EXPECT_THAT(errorAfter("period_s = 0.1", "period_s = 0.0"), testing::HasSubstr("motion.period_s"));
    EXPECT_THAT(errorAfter("period_s = 0.1", "period_s = \"fast\""), testing::HasSubstr("motion.period_s"));
    EXPECT_THAT(errorAfter("period_s = 0.1", "period_s = nan"), testing::HasSubstr("motion.period_s"));
    EXPECT_THAT(errorAfter("period_s = 0.1\n", ""), testing::HasSubstr("motion.period_s: is missing"));
    EXPECT_THAT(errorAfter("period_s = 0.1\n", "period_s = 0.1\nperiod_ms = 100\n"),
                testing::HasSubstr("motion.period_ms: is not a known key"));
    EXPECT_THAT(errorAfter("hidden = 13", "hidden = 12"), testing::HasSubstr("layers.hidden_weights"));
    EXPECT_THAT(errorAfter("quantity = \"command_v\"", "quantity = \"command_u\""),
                testing::HasSubstr("motion.reads[4].quantity"));
    EXPECT_THAT(errorAfter("robot = \"b\"", "robot = \"z\""), testing::HasSubstr("motion.reads[3].robot"));
    EXPECT_THAT(errorAfter("oldest_s = 0.04", "oldest_s = 0.0"), testing::HasSubstr("oldest_s"));
    EXPECT_THAT(errorAfter("oldest_s = 0.04", "oldest_s = 0.05"),
                testing::HasSubstr("motion.reads[4]: is \"command_v 0.0 to 0.05 s before\" in m/s; that input of the "
                                   "network is \"command_v 0.0 to 0.04 s before\" in m/s"));
    EXPECT_THAT(errorAfter("name = \"velocity_w\", unit = \"rad/s\"", "name = \"velocity_w\", unit = \"deg/s\""),
                testing::HasSubstr("motion.reads[2]: is \"velocity_w\" in rad/s; that input"));
    EXPECT_THAT(errorAfter("  { quantity = \"velocity_v\" },\n", ""),
                testing::HasSubstr("motion.reads: has 20 elements; the network has 21 inputs"));
    EXPECT_THAT(errorAfter("name = \"dx\"", "name = \"dz\""),
                testing::HasSubstr("motion.form: has other outputs than the network: expected dx m, dy m, "));
    EXPECT_THAT(errorAfter("name = \"dx\", unit = \"m\"", "name = \"dx\", unit = \"cm\""),
                testing::HasSubstr("motion.form: has other outputs"));
    EXPECT_THAT(errorAfter("[motion.recovery]", "[motion.recovery_]"), testing::HasSubstr("motion.recovery"));
    EXPECT_THAT(errorAfter("quantum_mps = 0.0084", "quantum_mps = 0"),
                testing::HasSubstr("motion.wheel_phase.quantum_mps"));
    EXPECT_THAT(errorAfter("[motion.wheel_phase]\nhalf_track_m = 0.13\nquantum_mps = 0.0084\n", ""),
                testing::HasSubstr("motion.wheel_phase: is missing; an input needs it"));
    const auto limits = [](const std::string& from, const std::string& to) {
        return errorAfter(from, to, Form::state);
    };
    EXPECT_THAT(limits("acceleration_v_mps2 = 0.55", "acceleration_v_mps2 = -0.55"),
                testing::HasSubstr("motion.limits.acceleration_v_mps2"));
    EXPECT_THAT(limits("longest_ramp_s = 1.5", "longest_ramp_s = 2.5"),
                testing::HasSubstr("motion.limits.longest_ramp_s"));
    EXPECT_THAT(limits("acceleration_v_mps2 = 0.55\nacceleration_w_radps2 = 4.7\n", ""),
                testing::HasSubstr("motion.limits.longest_ramp_s"));
    EXPECT_THAT(limits("wheel_speed_mps = 0.5", "wheel_speed_mps = 0"),
                testing::HasSubstr("motion.limits.wheel_speed_mps"));
    EXPECT_THAT(limits("half_track_m = 0.165\n", ""), testing::HasSubstr("motion.limits.half_track_m: is missing"));
    EXPECT_THAT(limits("[motion.limits]", "[motion.limits]\njerk = 1"), testing::HasSubstr("motion.limits.jerk"));
    EXPECT_THAT(errorAfter("held_out_error = {", "held_in_error = {"), testing::HasSubstr("motion.held_in_error"));
}

TEST(NetworkFile, RefusesAMistakenDescriptionOfWhatIsFamiliar) {
    MotionNetwork network = arbitraryNetwork(Form::history);
    network.familiar = arbitraryFamiliar();
    const std::string whole = networkText(network);
    const auto error = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        const std::size_t at = text.find(from, text.find("[motion.familiar]"));
        EXPECT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        const auto read = parseNetwork(text, "n.net");
        return read ? "no error" : read.error().message();
    };
    EXPECT_THAT(error("oldest_s = 0.44", "oldest_s = 0.04"), testing::HasSubstr("motion.familiar.v.oldest_s"));
    EXPECT_THAT(error("scale = 0.3", "scale = 0.0"), testing::HasSubstr("motion.familiar.w.scale"));
    EXPECT_THAT(error("0.5, 0.7, 1.1", "0.5, 0.4, 1.1"), testing::HasSubstr("motion.familiar.distances"));
    EXPECT_THAT(error("0.5, 0.7, 1.1", "0.5, 0.7"), testing::HasSubstr("motion.familiar.distances"));
    EXPECT_THAT(error("[-1.0, 2.0", "[2.0"), testing::HasSubstr("motion.familiar.prototypes"));
    EXPECT_THAT(error("periods = 4321", "periods = 0"), testing::HasSubstr("motion.familiar.periods"));
    EXPECT_THAT(error("periods = 4321", "periods = 1\nof = 2"), testing::HasSubstr("motion.familiar.of"));
}

TEST(NetworkFile, StateFormNeedsFiveOutputs) {
    EXPECT_THAT(errorAfter("form = \"history\"", "form = \"state\""), testing::HasSubstr("motion.form: has other"));
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
