#include "learning/network_file.h"

#include <limits>

#include "io/format.h"
#include "io/toml_table.h"
#include "io/toml_text.h"

namespace mrose {
namespace {

constexpr std::string_view networkFormat = "mrose network";
constexpr std::int64_t networkVersion = 1;
constexpr NumberRange anyFloat{-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};

std::string line(std::string_view key, const std::string& value) { return std::string(key) + " = " + value + '\n'; }
std::string line(std::string_view key, std::int64_t value) { return line(key, std::to_string(value)); }

std::string rowText(const float* values, int count) {
    std::string text = "[";
    for (int i = 0; i < count; ++i) text += (i ? ", " : "") + numberText(values[i]);
    return text + ']';
}

std::string variablesText(const std::vector<NetworkVariable>& variables) {
    std::string text;
    for (const NetworkVariable& v : variables)
        text += "  { name = " + tomlString(v.name) + ", unit = " + tomlString(v.unit) +
                ", mean = " + numberText(v.mean) + ", scale = " + numberText(v.scale) + " },\n";
    return text + "]\n";
}

std::string membersText(const std::vector<EnsembleMember>& members) {
    if (members.empty()) return {};
    std::string text = "members = [ # blocks of the hidden layer; the first outputs are the means of theirs\n";
    for (const EnsembleMember& member : members)
        text += "  { hidden = " + std::to_string(member.hidden) + ", output_biases = " +
                rowText(member.outputBiases.data(), static_cast<int>(member.outputBiases.size())) + " },\n";
    return text + "]\n";
}

std::string trainingText(const NetworkTraining& t) {
    std::string text = "\n[training]\n" + line("command", tomlString(t.command)) +
                       line("method", tomlString(t.method)) + line("loss", tomlString(t.loss)) +
                       line("seed", static_cast<std::int64_t>(t.seed)) + line("patterns", t.patterns) +
                       line("epochs", t.epochs) + "logs = [\n";
    for (const NetworkSource& log : t.logs)
        text += "  { path = " + tomlString(log.path) + ", xxh3 = " + tomlString(log.hash) + " },\n";
    return text + "]\n";
}

std::string holdOutText(const HoldOut& h) {
    if (!h.holdsAny()) return {};
    std::string rule = "every = " + std::to_string(h.every) + ", offset = " + std::to_string(h.offset);
    if (h.byTime()) rule += ", length_s = " + numberText(h.block) + ", guard_s = " + numberText(h.guard);
    const std::string which = h.byTime() ? "blocks" : "groups";
    return "\n[held_out] # what no part of learning has seen: the " + which + " whose number % every == offset\n" +
           line(which, "{ " + rule + " }");
}

std::string layersText(const Mlp& mlp) {
    const auto [inputs, hidden, outputs] = mlp.shape;
    const float* p = mlp.parameters.data();
    std::string text = "\n[layers]\nhidden_weights = [ # a row for each hidden unit\n";
    for (int j = 0; j < hidden; ++j, p += inputs) text += "  " + rowText(p, inputs) + ",\n";
    text += "]\nhidden_biases = " + rowText(p, hidden) + '\n';
    p += hidden;
    text += "output_weights = [ # a row for each output\n";
    for (int k = 0; k < outputs; ++k, p += hidden) text += "  " + rowText(p, hidden) + ",\n";
    return text + "]\noutput_biases = " + rowText(p, outputs) + '\n';
}

void readFormat(TomlTable& root, std::string_view kind) {
    if (const std::string format = root.string("format"); format != networkFormat)
        root.reject("format", "is \"" + format + "\"; expected a network file, \"" + std::string(networkFormat) + '"');
    constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max();
    if (const std::int64_t version = root.integer("version", 0, any); version != networkVersion)
        root.reject("version",
                    "is " + std::to_string(version) + "; this program reads version " + std::to_string(networkVersion));
    if (const std::string is = root.string("kind"); is != kind)
        root.reject("kind",
                    "is a network of another kind, \"" + is + "\"; expected one of \"" + std::string(kind) + '"');
}

std::vector<NetworkVariable> readVariables(TomlTable& root, std::string_view key, std::size_t most) {
    std::vector<NetworkVariable> variables;
    std::vector<TomlTable> tables = root.tables(key);
    if (tables.empty() || tables.size() > most)
        root.reject(key, "has " + std::to_string(tables.size()) + " elements; expected 1 to " + std::to_string(most));
    if (root.failed()) return variables;
    for (TomlTable& table : tables) {
        NetworkVariable v;
        v.name = table.string("name");
        v.unit = table.string("unit");
        v.mean = table.number("mean");
        v.scale = table.number("scale", {1e-12, 1e12});
        for (const NetworkVariable& other : variables)
            if (other.name == v.name) table.reject("name", "\"" + v.name + "\" is the name of two");
        table.rejectUnknown();
        variables.push_back(std::move(v));
    }
    return variables;
}

std::vector<EnsembleMember> readMembers(TomlTable& root, std::size_t outputs) {
    std::vector<EnsembleMember> members;
    for (TomlTable& table : root.tablesOrNone("members")) {
        EnsembleMember member;
        member.hidden = static_cast<int>(table.integer("hidden", 1, std::int64_t{LearnedNetwork::maxHidden}));
        for (const double bias : table.someNumbers("output_biases", 1, outputs, anyFloat))
            member.outputBiases.push_back(static_cast<float>(bias));
        table.rejectUnknown();
        members.push_back(std::move(member));
    }
    return members;
}

}  // namespace

std::string networkFileText(const LearnedNetwork& network, std::string_view section) {
    return "# A network learned by mrose; nets/README.md explains the keys.\n" +
           line("format", tomlString(networkFormat)) + line("version", networkVersion) +
           line("kind", tomlString(network.kind)) + line("synthetic", network.synthetic ? "true" : "false") +
           line("hidden", std::int64_t{network.mlp.shape.hidden}) +
           "inputs = [ # the network reads (value - mean) / scale\n" + variablesText(network.inputs) +
           "outputs = [ # the value is mean + scale * output\n" + variablesText(network.outputs) +
           membersText(network.members) + '\n' + std::string(section) + trainingText(network.training) +
           holdOutText(network.holdOut) + layersText(network.mlp);
}

NetworkTraining readNetworkTraining(TomlTable table) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    NetworkTraining t;
    t.command = table.string("command");
    t.method = table.string("method");
    t.loss = table.string("loss");
    t.seed = static_cast<std::uint64_t>(table.integer("seed", std::numeric_limits<std::int64_t>::min(), most));
    t.patterns = table.integer("patterns", 0, most);
    t.epochs = table.integer("epochs", 0, most);
    for (TomlTable& log : table.tables("logs")) {
        t.logs.push_back({log.string("path"), log.string("xxh3")});
        log.rejectUnknown();
    }
    table.rejectUnknown();
    return t;
}

Mlp readNetworkLayers(TomlTable table, const MlpShape& shape) {
    Mlp mlp{shape, {}};
    const auto inputs = static_cast<std::size_t>(shape.inputs), hidden = static_cast<std::size_t>(shape.hidden),
               outputs = static_cast<std::size_t>(shape.outputs);
    for (const auto& values :
         {table.matrix("hidden_weights", hidden, inputs, anyFloat), table.numbers("hidden_biases", hidden, anyFloat),
          table.matrix("output_weights", outputs, hidden, anyFloat), table.numbers("output_biases", outputs, anyFloat)})
        for (const double value : values) mlp.parameters.push_back(static_cast<float>(value));
    table.rejectUnknown();
    return mlp;
}

HoldOut readHoldOut(TomlTable& table) {
    HoldOut h;
    if (!table.has("groups") && !table.has("blocks")) return h;
    table.expectOneOf("groups", "blocks", "groups or blocks");
    if (table.failed()) return h;
    const bool byTime = table.has("blocks");
    TomlTable rule = table.table(byTime ? "blocks" : "groups");
    h.every = static_cast<int>(rule.integer("every", 2, 1'000'000));
    h.offset = static_cast<int>(rule.integer("offset", 0, 1'000'000));
    if (h.offset >= h.every) rule.reject("offset", "expected less than every");
    if (byTime) {
        h.block = rule.number("length_s", {1, 1e6});
        h.guard = rule.number("guard_s", {0, 1e6});
    }
    rule.rejectUnknown();
    return h;
}

Expected<LearnedNetwork> readNetworkFile(TomlTable& root, std::string_view kind,
                                         const NetworkSectionReader& readSection) {
    LearnedNetwork network;
    network.kind = kind;
    readFormat(root, kind);
    if (root.failed()) return tl::unexpected(root.error());
    network.synthetic = root.boolean("synthetic");
    const auto hidden = static_cast<int>(root.integer("hidden", 1, std::int64_t{LearnedNetwork::maxHidden}));
    network.inputs = readVariables(root, "inputs", LearnedNetwork::maxInputs);
    network.outputs = readVariables(root, "outputs", LearnedNetwork::maxOutputs);
    network.members = readMembers(root, network.outputs.size());
    network.training = readNetworkTraining(root.table("training"));
    if (root.has("held_out")) {
        TomlTable table = root.table("held_out");
        network.holdOut = readHoldOut(table);
        table.rejectUnknown();
    }
    TomlTable section = root.table(kind);
    readSection(section, network);
    section.rejectUnknown();
    const MlpShape shape{static_cast<int>(network.inputs.size()), hidden, static_cast<int>(network.outputs.size())};
    if (!root.failed()) network.mlp = readNetworkLayers(root.table("layers"), shape);
    if (!root.failed() && !network.members.empty() && !isMeanOf(network.mlp, network.members))
        root.reject("members",
                    "do not make up this network: expected blocks that fill the hidden layer, with output "
                    "biases whose means are the network's");
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    return network;
}

}  // namespace mrose
