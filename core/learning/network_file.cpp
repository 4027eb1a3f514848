#include "learning/network_file.h"

#include <algorithm>
#include <cmath>
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

std::string mappingText(const Mlp& mlp) {
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

std::string mappingText(const LookupTable& table) {
    std::string text;
    for (const LookupTable::Grid& grid : table.grids) {
        text += "\n[[grid]] # values: a row of outputs for each point, the last axis' points side by side\naxes = [\n";
        for (const LookupTable::Axis& axis : grid.axes)
            text += "  { input = " + std::to_string(axis.input) +
                    ", knots = " + rowText(axis.knots.data(), static_cast<int>(axis.knots.size())) + " },\n";
        text += "]\nvalues = [\n";
        for (std::size_t point = 0; point < grid.points(); ++point)
            text += "  " +
                    rowText(grid.values.data() + point * static_cast<std::size_t>(table.outputs), table.outputs) +
                    ",\n";
        text += "]\n";
    }
    return text;
}

std::string mappingText(const DecisionTrees& trees) {
    std::string text =
        "\n[decision_trees]\ntrees = [ # nodes: [input, value, left, right], a leaf's input is -1; on at left where "
        "the "
        "input <= value\n";
    for (const DecisionTrees::Tree& tree : trees.trees) {
        text += "  { output = " + std::to_string(tree.output) + ", nodes = [";
        for (const DecisionTrees::Node& node : tree.nodes)
            text += (&node == tree.nodes.data() ? "[" : ", [") + std::to_string(node.input) + ", " +
                    numberText(node.value) + ", " + std::to_string(node.left) + ", " + std::to_string(node.right) + "]";
        text += "] },\n";
    }
    return text + "]\n";
}

std::string mappingText(const NearestNeighbours& of) {
    const auto width = static_cast<int>(of.read.size());
    std::string text = "\n[nearest_neighbours]\nneighbours = " + std::to_string(of.neighbours) + "\nread = [";
    for (int i = 0; i < width; ++i) text += (i > 0 ? ", " : "") + std::to_string(of.read[static_cast<std::size_t>(i)]);
    text += "] # inputs, from 0\npatterns = [ # those inputs, then the outputs\n";
    for (std::size_t p = 0; p < of.patterns(); ++p) {
        std::vector<float> row(of.points.begin() + static_cast<std::ptrdiff_t>(p) * width,
                               of.points.begin() + static_cast<std::ptrdiff_t>(p + 1) * width);
        const auto values = of.values.begin() + static_cast<std::ptrdiff_t>(p) * of.outputs;
        row.insert(row.end(), values, values + of.outputs);
        text += "  " + rowText(row.data(), static_cast<int>(row.size())) + ",\n";
    }
    return text + "]\n";
}

LookupTable::Axis readAxis(TomlTable& table, int inputs) {
    LookupTable::Axis axis;
    axis.input = static_cast<int>(table.integer("input", 0, inputs - 1));
    for (const double knot : table.someNumbers("knots", 2, LookupTable::maxPoints, anyFloat)) {
        if (!axis.knots.empty() && static_cast<float>(knot) <= axis.knots.back())
            table.reject("knots", "expected ascending numbers");
        axis.knots.push_back(static_cast<float>(knot));
    }
    table.rejectUnknown();
    return axis;
}

LookupTable readTable(TomlTable& root, int inputs, int outputs) {
    LookupTable read{inputs, outputs, {}};
    for (TomlTable& table : root.tables("grid")) {
        LookupTable::Grid grid;
        std::vector<TomlTable> axes = table.tables("axes");
        if (axes.empty() || axes.size() > LookupTable::maxAxes)
            table.reject("axes", "expected 1 to " + std::to_string(LookupTable::maxAxes) + " axes");
        if (table.failed()) return read;
        std::size_t points = 1;
        for (TomlTable& axis : axes) {
            grid.axes.push_back(readAxis(axis, inputs));
            points *= std::max<std::size_t>(grid.axes.back().knots.size(), 1);
            if (points > LookupTable::maxPoints) axis.reject("knots", "make too many points together");
            if (axis.failed()) return read;
        }
        for (const double value : table.matrix("values", points, static_cast<std::size_t>(outputs), anyFloat))
            grid.values.push_back(static_cast<float>(value));
        table.rejectUnknown();
        read.grids.push_back(std::move(grid));
    }
    return read;
}

/// What is wrong with nodes; "": nothing.
std::string wrongNodes(const std::vector<DecisionTrees::Node>& nodes, int inputs) {
    const auto count = static_cast<int>(nodes.size());
    for (int i = 0; i < count; ++i) {
        const DecisionTrees::Node& node = nodes[static_cast<std::size_t>(i)];
        if (node.input < -1 || node.input >= inputs) return "expected inputs from -1 to " + std::to_string(inputs - 1);
        const bool ahead = node.left > i && node.right > i && node.left < count && node.right < count;
        if (node.input >= 0 && !ahead) return "node " + std::to_string(i) + " must go on at later nodes of the tree";
    }
    return {};
}

DecisionTrees readTrees(TomlTable part, int inputs, int outputs) {
    DecisionTrees read{inputs, outputs, {}};
    std::vector<TomlTable> tables = part.tables("trees");
    if (tables.size() > LearnedNetwork::maxTrees)
        part.reject("trees", "expected at most " + std::to_string(LearnedNetwork::maxTrees));
    for (TomlTable& table : tables) {
        DecisionTrees::Tree tree;
        tree.output = static_cast<int>(table.integer("output", 0, outputs - 1));
        const std::vector<double> numbers = table.rows("nodes", 4, 1, DecisionTrees::maxNodes, anyFloat);
        const auto whole = [&](std::size_t i) {
            const double number = numbers[i];
            if (!(std::abs(number) <= double(DecisionTrees::maxNodes)) || number != std::floor(number))
                table.reject("nodes", "expected whole numbers of inputs and nodes");
            return table.failed() ? -1 : static_cast<int>(number);
        };
        for (std::size_t i = 0; i + 3 < numbers.size() && !table.failed(); i += 4)
            tree.nodes.push_back({whole(i), static_cast<float>(numbers[i + 1]), whole(i + 2), whole(i + 3)});
        if (const std::string wrong = wrongNodes(tree.nodes, inputs); !wrong.empty()) table.reject("nodes", wrong);
        table.rejectUnknown();
        if (table.failed()) return read;
        read.trees.push_back(std::move(tree));
    }
    if (read.nodeCount() > DecisionTrees::maxNodes) part.reject("trees", "have too many nodes");
    part.rejectUnknown();
    return read;
}

NearestNeighbours readNeighbours(TomlTable part, int inputs, int outputs) {
    NearestNeighbours read{inputs, outputs, 1, {}, {}, {}};
    read.neighbours = static_cast<int>(part.integer("neighbours", 1, std::int64_t{NearestNeighbours::maxNeighbours}));
    for (const double input : part.someNumbers("read", 1, static_cast<std::size_t>(inputs), {0, inputs - 1.0})) {
        if (input != std::floor(input) || (!read.read.empty() && input <= read.read.back()))
            part.reject("read", "expected ascending whole numbers of inputs");
        read.read.push_back(static_cast<int>(input));
    }
    const std::size_t width = read.read.size(), columns = width + static_cast<std::size_t>(outputs);
    const std::vector<double> rows =
        part.rows("patterns", columns, 1, NearestNeighbours::maxValues / std::max<std::size_t>(columns, 1), anyFloat);
    for (std::size_t i = 0; i < rows.size(); ++i)
        (i % columns < width ? read.points : read.values).push_back(static_cast<float>(rows[i]));
    if (!part.failed() && read.neighbours > static_cast<int>(read.patterns()))
        part.reject("neighbours", "are more than there are patterns");
    part.rejectUnknown();
    return read;
}

void readNetwork(TomlTable& root, const MlpShape& shape, LearnedNetwork& network) {
    Mlp mlp = readNetworkLayers(root.table("layers"), shape);
    if (!root.failed() && !network.members.empty() && !isMeanOf(mlp, network.members))
        root.reject("members",
                    "do not make up this network: expected blocks that fill the hidden layer, with output "
                    "biases whose means are the network's");
    network.regressor = std::move(mlp);
}

std::string familyText(const LearnedNetwork& network) {
    if (const auto* const mlp = std::get_if<Mlp>(&network.regressor))
        return line("hidden", std::int64_t{mlp->shape.hidden});
    return line("family", tomlString(nameOf(familyOf(network.regressor))));
}

RegressorFamily readFamily(TomlTable& root, std::string_view kind, std::span<const std::string_view> families) {
    if (!root.has("family")) return RegressorFamily::network;
    const auto family = static_cast<RegressorFamily>(root.choice("family", regressorFamilyNames));
    if (std::find(families.begin(), families.end(), nameOf(family)) != families.end()) return family;
    std::string expected;
    for (const std::string_view known : families)
        expected += (expected.empty() ? "\"" : "\" or \"") + std::string(known);
    root.reject("family", "is \"" + std::string(nameOf(family)) + "\"; expected \"" + expected.substr(1) +
                              "\" of a \"" + std::string(kind) + "\" network");
    return family;
}

void readFormat(TomlTable& root, std::string_view kind) {
    if (const std::string format = root.string("format"); format != networkFormat)
        root.reject("format", "is \"" + format + "\"; expected a network file, \"" + std::string(networkFormat) + '"');
    constexpr std::int64_t any = std::numeric_limits<std::int64_t>::max();
    if (const std::int64_t version = root.integer("version", 0, any); version != networkVersion)
        root.reject("version",
                    "is " + std::to_string(version) + "; this program reads version " + std::to_string(networkVersion));
    if (const std::string is = root.string("kind"); is != kind)
        root.reject("kind", "is a network of another kind, \"" + is + "\"; expected \"" + std::string(kind) + '"');
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
           familyText(network) + "inputs = [ # the network reads (value - mean) / scale\n" +
           variablesText(network.inputs) + "outputs = [ # the value is mean + scale * output\n" +
           variablesText(network.outputs) + membersText(network.members) + '\n' + std::string(section) +
           trainingText(network.training) + holdOutText(network.holdOut) +
           std::visit([](const auto& mapping) { return mappingText(mapping); }, network.regressor);
}

std::string networkKind(std::string_view text) {
    TomlTable root(text, "");
    const bool known = !root.failed() && root.stringOr("format", "") == networkFormat;
    return known ? root.stringOr("kind", "") : "";
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
                                         const NetworkSectionReader& readSection,
                                         std::span<const std::string_view> families) {
    LearnedNetwork network;
    network.kind = kind;
    readFormat(root, kind);
    if (root.failed()) return tl::unexpected(root.error());
    network.synthetic = root.boolean("synthetic");
    const RegressorFamily family = readFamily(root, kind, families);
    const bool isNetwork = family == RegressorFamily::network;
    const auto hidden =
        isNetwork ? static_cast<int>(root.integer("hidden", 1, std::int64_t{LearnedNetwork::maxHidden})) : 0;
    network.inputs = readVariables(root, "inputs", LearnedNetwork::maxInputs);
    network.outputs = readVariables(root, "outputs", LearnedNetwork::maxOutputs);
    if (isNetwork) network.members = readMembers(root, network.outputs.size());
    network.training = readNetworkTraining(root.table("training"));
    if (root.has("held_out")) {
        TomlTable table = root.table("held_out");
        network.holdOut = readHoldOut(table);
        table.rejectUnknown();
    }
    TomlTable section = root.table(kind);
    readSection(section, network);
    section.rejectUnknown();
    const int inputs = static_cast<int>(network.inputs.size()), outputs = static_cast<int>(network.outputs.size());
    if (root.failed()) return tl::unexpected(root.error());
    if (family == RegressorFamily::table)
        network.regressor = readTable(root, inputs, outputs);
    else if (family == RegressorFamily::neighbours)
        network.regressor = readNeighbours(root.table("nearest_neighbours"), inputs, outputs);
    else if (family == RegressorFamily::trees)
        network.regressor = readTrees(root.table("decision_trees"), inputs, outputs);
    else
        readNetwork(root, {inputs, hidden, outputs}, network);
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    return network;
}

}  // namespace mrose
