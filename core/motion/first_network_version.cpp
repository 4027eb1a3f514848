// Network files as they were before there were other kinds than motion: all keys at the root, units in the names.
#include "learning/network_file.h"
#include "motion/network_section.h"
#include "motion/network_words.h"

namespace mrose {
namespace {

constexpr std::string_view firstFormat = "mrose motion network";

void readFirstOutputs(TomlTable& root, MotionNetwork& network) {
    std::vector<TomlTable> tables = root.tables("outputs");
    const std::vector<NetworkVariable> expected = outputVariables(network.form);
    if (tables.size() != expected.size())
        root.reject("outputs", "has " + std::to_string(tables.size()) + " outputs; this form has " +
                                   std::to_string(expected.size()));
    for (std::size_t i = 0; i < tables.size() && i < expected.size(); ++i) {
        const std::string unit = expected[i].unit == "m/s"     ? "mps"
                                 : expected[i].unit == "rad/s" ? "radps"
                                                               : expected[i].unit;
        const std::string name = expected[i].name + '_' + unit;
        tables[i].choice("name", {name});
        NetworkOutput output;
        output.mean = tables[i].number("mean");
        output.scale = tables[i].number("scale", {1e-12, 1e12});
        tables[i].rejectUnknown();
        network.outputs.push_back(output);
    }
}

void readFirstInputs(TomlTable& root, MotionNetwork& network) {
    for (TomlTable& table : root.tables("inputs")) {
        NetworkInput input = readNetworkInput(table, network.robots);
        input.mean = table.number("mean");
        input.scale = table.number("scale", {1e-12, 1e12});
        table.rejectUnknown();
        network.inputs.push_back(std::move(input));
    }
    if (network.inputs.empty() || network.inputs.size() > LearnedNetwork::maxInputs)
        root.reject("inputs", "expected 1 to " + std::to_string(LearnedNetwork::maxInputs) + " inputs");
}

void readFirstHeldOut(TomlTable table, MotionNetwork::HeldOut& heldOut) {
    readHeldOutError(table, heldOut);
    heldOut.part = readHoldOut(table);
    table.rejectUnknown();
}

}  // namespace

bool isFirstMotionVersion(TomlTable& root) { return root.has("format") && root.string("format") == firstFormat; }

Expected<MotionNetwork> readFirstMotionVersion(TomlTable& root) {
    MotionNetwork network;
    root.choice("format", {firstFormat});
    root.integer("version", 1, 1);
    network.synthetic = root.boolean("synthetic");
    readMotionBasics(root, network);
    const auto hidden = static_cast<int>(root.integer("hidden", 1, std::int64_t{LearnedNetwork::maxHidden}));
    readFirstInputs(root, network);
    readFirstOutputs(root, network);
    readMotionParts(root, network);
    checkMotionInputs(root, network);
    network.training = readNetworkTraining(root.table("training"));
    readFirstHeldOut(root.table("held_out"), network.heldOut);
    const MlpShape shape{int(network.inputs.size()), hidden, int(network.outputs.size())};
    if (!root.failed()) network.mlp = readNetworkLayers(root.table("layers"), shape);
    if (!root.failed()) root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    return network;
}

}  // namespace mrose
