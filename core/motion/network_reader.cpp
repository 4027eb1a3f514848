#include "io/file.h"
#include "io/toml_table.h"
#include "learning/network_file.h"
#include "motion/motion_network.h"
#include "motion/network_section.h"
#include "motion/network_words.h"

namespace mrose {
namespace {

/// What the inputs are, beside what the general part says of them.
void readInputs(TomlTable& section, const LearnedNetwork& general, MotionNetwork& network) {
    std::vector<TomlTable> tables = section.tables("reads");
    if (tables.size() != general.inputs.size())
        section.reject("reads", "has " + std::to_string(tables.size()) + " elements; the network has " +
                                    std::to_string(general.inputs.size()) + " inputs");
    for (std::size_t i = 0; i < tables.size() && !section.failed(); ++i) {
        NetworkInput input = readNetworkInput(tables[i], network.robots);
        tables[i].rejectUnknown();
        const NetworkVariable& variable = general.inputs[i];
        if (variable.name != inputName(input) || variable.unit != inputUnit(input))
            section.rejectElement("reads", i,
                                  "is \"" + inputName(input) + "\" in " + std::string(inputUnit(input)) +
                                      "; that input of the network is \"" + variable.name + "\" in " + variable.unit);
        input.mean = variable.mean;
        input.scale = variable.scale;
        network.inputs.push_back(std::move(input));
    }
}

void readOutputs(TomlTable& section, const LearnedNetwork& general, MotionNetwork& network) {
    const std::vector<NetworkVariable> expected = outputVariables(network.form);
    std::string names;
    bool fits = general.outputs.size() == expected.size();
    for (std::size_t i = 0; i < expected.size(); ++i) {
        names += (names.empty() ? "" : ", ") + expected[i].name + ' ' + expected[i].unit;
        fits = fits && general.outputs[i].name == expected[i].name && general.outputs[i].unit == expected[i].unit;
    }
    if (!fits) section.reject("form", "has other outputs than the network: expected " + names);
    for (const NetworkVariable& output : general.outputs) network.outputs.push_back({output.mean, output.scale});
}

}  // namespace

Expected<MotionNetwork> parseNetwork(std::string_view text, const std::string& file) {
    TomlTable root(text, file);
    if (isFirstMotionVersion(root)) return readFirstMotionVersion(root);
    MotionNetwork network;
    const auto readSection = [&](TomlTable& section, const LearnedNetwork& read) {
        readMotionBasics(section, network);
        readInputs(section, read, network);
        readOutputs(section, read, network);
        TomlTable error = section.table("held_out_error");
        readHeldOutError(error, network.heldOut);
        error.rejectUnknown();
        readMotionParts(section, network);
        checkMotionInputs(section, network);
    };
    constexpr std::string_view families[] = {nameOf(RegressorFamily::network)};
    auto general = readNetworkFile(root, motionKind, readSection, families);
    if (!general) return tl::unexpected(general.error());
    network.synthetic = general->synthetic;
    network.mlp = std::get<Mlp>(std::move(general->regressor));
    network.members = std::move(general->members);
    network.training = std::move(general->training);
    network.heldOut.part = general->holdOut;
    if (network.noise && network.members.size() > ResidualNoise::maxMembers)
        return fail(file, "is of " + std::to_string(network.members.size()) + " networks; noise is drawn of at most " +
                              std::to_string(ResidualNoise::maxMembers));
    return network;
}

Expected<MotionNetwork> loadNetwork(const std::filesystem::path& path) {
    return readFile(path).and_then([&](const std::string& text) { return parseNetwork(text, path.string()); });
}

}  // namespace mrose
