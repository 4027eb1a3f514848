// The part that all network files have, with a kind that nothing in the program knows.
#include "learning/network_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/toml_table.h"
#include "learning/reference_network.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;

LearnedNetwork nose() {
    const std::vector<Mlp> members{test::normalNetwork({2, 3, 1}, 1), test::normalNetwork({2, 2, 1}, 2)};
    LearnedNetwork network;
    network.kind = "nose";
    network.synthetic = true;
    network.inputs = {{"distance", "m", 1.0 / 3, 0.1}, {"wind \"w\"", "m/s", -1e-17, 7}};
    network.outputs = {{"smell", "1", 0.25, 1e-3}};
    network.regressor = mergedMean(members);
    network.members = membersOf(members);
    network.training = {"mrose smell a\tb",
                        "irprop+",
                        "likelihood",
                        18446744073709551615u,
                        12,
                        34,
                        {{"a.csv", "0123456789abcdef"}, {"b.csv", "fedcba9876543210"}}};
    network.holdOut = {5, 3};
    return network;
}

constexpr const char* section = "[nose]\nnostrils = 2\n\n[nose.left]\nopen = true\n";

struct Nose {
    std::int64_t nostrils = 0;
    bool open = false;
    std::size_t inputs = 0;
};

Expected<LearnedNetwork> parseNose(const std::string& text, Nose* nose = nullptr) {
    TomlTable root(text, "n.net");
    return readNetworkFile(root, "nose", [&](TomlTable& table, const LearnedNetwork& network) {
        Nose read{table.integer("nostrils", 1, 8), false, network.inputs.size()};
        TomlTable left = table.table("left");
        read.open = left.boolean("open");
        left.rejectUnknown();
        if (nose != nullptr) *nose = read;
    });
}

TEST(AnyNetworkFile, ReadsBackEveryBitAndTheSectionOfItsKind) {
    const LearnedNetwork network = nose();
    const std::string text = networkFileText(network, section);
    Nose read;
    const auto again = parseNose(text, &read);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(*again == network);
    EXPECT_EQ(networkFileText(*again, section), text);
    EXPECT_EQ(read.nostrils, 2);
    EXPECT_TRUE(read.open);
    EXPECT_EQ(read.inputs, 2u) << "a section sees the inputs that it explains";
}

TEST(AnyNetworkFile, ReadsBackWithoutMembersAndAnyHeldOutPart) {
    LearnedNetwork network = nose();
    network.members.clear();
    network.holdOut = {5, 3, 44, 2.6};
    const auto blocks = parseNose(networkFileText(network, section));
    ASSERT_TRUE(blocks) << blocks.error().message();
    EXPECT_TRUE(*blocks == network);
    network.holdOut = {};
    const auto again = parseNose(networkFileText(network, section));
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(*again == network);
}

/// The error of a file in which `from` was replaced by `to`.
std::string errorAfter(const std::string& from, const std::string& to) {
    std::string text = networkFileText(nose(), section);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const auto read = parseNose(text);
    return read ? "no error" : read.error().message();
}

TEST(AnyNetworkFile, OfAnotherKindSaysWhichItIs) {
    EXPECT_THAT(errorAfter("kind = \"nose\"", "kind = \"ear\""),
                MatchesRegex("n.net:4:[0-9]+: kind: is a network of another kind, \"ear\"; expected \"nose\""));
    EXPECT_THAT(errorAfter("format = \"mrose network\"", "format = \"mrose robot\""),
                MatchesRegex("n.net:2:[0-9]+: format: is \"mrose robot\"; expected a network file, \"mrose network\""));
    EXPECT_THAT(errorAfter("version = 1", "version = 7"),
                MatchesRegex("n.net:3:[0-9]+: version: is 7; this program reads version 1"));
    EXPECT_THAT(errorAfter("format = \"mrose network\"\n", ""), HasSubstr("format: is missing"));
    EXPECT_THAT(errorAfter("kind = \"nose\"\n", ""), HasSubstr("kind: is missing"));
}

TEST(AnyNetworkFile, NamesFileLineAndKeyOfWhatDoesNotFit) {
    EXPECT_THAT(errorAfter("hidden = 5", "hidden = 4"), HasSubstr("layers.hidden_weights: expected 4 arrays"));
    EXPECT_THAT(errorAfter("hidden = 5", "hidden = 999999999999"), MatchesRegex("n.net:6:[0-9]+: hidden: .*4096"));
    EXPECT_THAT(errorAfter("unit = \"m\", ", ""), HasSubstr("inputs[\"distance\"].unit: is missing"));
    EXPECT_THAT(errorAfter("scale = 7.0", "scale = 0.0"), HasSubstr("inputs[\"wind \"w\"\"].scale: is 0.0; expected"));
    EXPECT_THAT(errorAfter("scale = 7.0", "scale = 7.0, spread = 1.0"), HasSubstr("spread: is not a known key"));
    EXPECT_THAT(errorAfter("name = \"wind \\\"w\\\"\"", "name = \"distance\""),
                HasSubstr("inputs[\"distance\"].name: \"distance\" is the name of two"));
    EXPECT_THAT(errorAfter("  { name = \"smell\", unit = \"1\", mean = 0.25, scale = 0.001 },\n", ""),
                HasSubstr("outputs: has 0 elements; expected 1 to 256"));
    EXPECT_THAT(errorAfter("nostrils = 2", "nostrils = 9"), MatchesRegex("n.net:[0-9]+:[0-9]+: nose.nostrils: .*"));
    EXPECT_THAT(errorAfter("nostrils = 2", "nostrils = 2\nhairs = 9"),
                HasSubstr("nose.hairs: is not a known key; expected one of"));
    EXPECT_THAT(errorAfter("[nose]\nnostrils = 2\n\n[nose.left]\nopen = true\n", ""), HasSubstr("nose: is missing"));
    EXPECT_THAT(errorAfter("[training]", "[ear]\nx = 1\n[training]"), HasSubstr("ear: is not a known key"));
    EXPECT_THAT(errorAfter("[training]", "[trainings]"), HasSubstr("trainings: is not a known key; did you mean"));
    EXPECT_THAT(errorAfter("seed = -1", "seed = 0.5"), HasSubstr("training.seed"));
    EXPECT_THAT(errorAfter("hidden_biases = [", "hidden_biases = [1.0, "), HasSubstr("layers.hidden_biases"));
    EXPECT_THAT(errorAfter("hidden_biases = [", "hidden_biases = [\"1\", "), HasSubstr("layers.hidden_biases"));
    EXPECT_THAT(errorAfter("output_biases = [", "output_biases = [4e38, "), HasSubstr("output_biases"));
}

TEST(AnyNetworkFile, MembersMakeUpTheNetwork) {
    for (const auto& [from, to] : {std::pair("{ hidden = 3, output_biases = [", "{ hidden = 2, output_biases = ["),
                                   std::pair("{ hidden = 3, output_biases = [", "{ hidden = 3, output_biases = [1")})
        EXPECT_THAT(errorAfter(from, to), MatchesRegex("n.net:[0-9]+:[0-9]+: members: do not make up this network.*"));
    EXPECT_THAT(errorAfter("{ hidden = 3,", "{ hidden = 0,"), HasSubstr("members[1].hidden"));
    EXPECT_THAT(errorAfter("{ hidden = 3,", "{ hidden = 3, weight = 2,"), HasSubstr("members[1].weight"));
    EXPECT_THAT(errorAfter("{ hidden = 3, output_biases = [", "{ hidden = 3, output_biases = [0.1, "),
                HasSubstr("members[1].output_biases: expected 1 to 1 numbers"));
}

TEST(AnyNetworkFile, HeldOutGroupsMustBeARule) {
    const std::string rule = "{ every = 5, offset = 3 }";
    EXPECT_EQ(errorAfter(rule, "{ every = 5, offset = 4 }"), "no error");
    EXPECT_THAT(errorAfter(rule, "{ every = 1, offset = 0 }"), HasSubstr("held_out.groups.every"));
    EXPECT_THAT(errorAfter(rule, "{ every = 5, offset = 5 }"), HasSubstr("held_out.groups.offset: expected less"));
    EXPECT_THAT(errorAfter(rule, "{ every = 5, offset = -1 }"), HasSubstr("held_out.groups.offset"));
    EXPECT_THAT(errorAfter(rule, "{ every = 5 }"), HasSubstr("held_out.groups.offset: is missing"));
    EXPECT_THAT(errorAfter(rule, "{ every = 5, offset = 3, share = 0.2 }"), HasSubstr("held_out.groups.share"));
    EXPECT_THAT(errorAfter(rule, "\"group % 5\""), HasSubstr("held_out.groups"));
    EXPECT_THAT(errorAfter("groups = { every", "group = { every"), HasSubstr("held_out.group"));
}

TEST(AnyNetworkFile, HeldOutBlocksSayHowLongTheyAreAndTheirGuard) {
    const std::string rule = "groups = { every = 5, offset = 3 }";
    const auto errorOf = [&](const std::string& blocks) { return errorAfter(rule, blocks); };
    EXPECT_EQ(errorOf("blocks = { every = 5, offset = 3, length_s = 44, guard_s = 0.0 }"), "no error");
    EXPECT_THAT(errorOf("blocks = { every = 5, offset = 3, guard_s = 2.5 }"),
                HasSubstr("held_out.blocks.length_s: is missing"));
    EXPECT_THAT(errorOf("blocks = { every = 5, offset = 3, length_s = 44 }"),
                HasSubstr("held_out.blocks.guard_s: is missing"));
    EXPECT_THAT(errorOf("blocks = { every = 5, offset = 3, length_s = 0, guard_s = 2.5 }"),
                HasSubstr("held_out.blocks.length_s: is 0.0; expected"));
    EXPECT_THAT(errorOf("blocks = { every = 5, offset = 3, length_s = 44, guard_s = -1 }"),
                HasSubstr("held_out.blocks.guard_s"));
    EXPECT_THAT(errorOf("blocks = { every = 5, offset = 5, length_s = 44, guard_s = 1 }"),
                HasSubstr("held_out.blocks.offset: expected less"));
    EXPECT_THAT(errorOf(rule + "\nblocks = { every = 5, offset = 3, length_s = 44, guard_s = 1 }"),
                HasSubstr("held_out.groups: expected either groups or blocks"));
    EXPECT_THAT(errorAfter("groups = { every = 5, offset = 3 }", "groups = { every = 5, offset = 3, guard_s = 1 }"),
                HasSubstr("held_out.groups.guard_s: is not a known key"));
}

TEST(AnyNetworkFile, TruncatedAnywhereIsAnError) {
    const std::string text = networkFileText(nose(), section);
    for (std::size_t length = 0; length + 2 < text.size(); length += 13)
        EXPECT_FALSE(parseNose(text.substr(0, length))) << length;
}

}  // namespace
}  // namespace mrose
