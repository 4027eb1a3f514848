#include <algorithm>
#include <limits>

#include "io/file.h"
#include "io/toml_table.h"
#include "motion/motion_network.h"
#include "motion/network_words.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;
using Form = MotionNetwork::Form;

NetworkInput readInput(TomlTable table, const std::vector<std::string>& robots) {
    NetworkInput input;
    input.quantity = static_cast<Quantity>(table.choice("quantity", quantityNames));
    if (input.quantity == Quantity::robot) {
        input.robot = table.string("robot");
        if (std::find(robots.begin(), robots.end(), input.robot) == robots.end())
            table.reject("robot", "is not one of the network's robots");
    }
    if (input.fromCommands()) {
        input.newest = table.number("newest_s", {0, 10});
        input.oldest = table.number("oldest_s", {0, 10});
        if (input.oldest <= input.newest) table.reject("oldest_s", "expected more than newest_s");
    }
    input.mean = table.number("mean");
    input.scale = table.number("scale", {1e-12, 1e12});
    table.rejectUnknown();
    return input;
}

KinematicParameters::Channel readChannel(TomlTable table) {
    KinematicParameters::Channel c;
    c.deadTime = table.number("dead_time_s", {0, 10});
    c.lag = table.number("lag_s", {0, 10});
    c.gain = table.number("gain");
    c.bias = table.number("bias");
    c.limit = table.number("limit", {0, 1e6});
    c.acceleration = table.number("acceleration", {0, 1e6});
    table.rejectUnknown();
    return c;
}

KinematicParameters readKinematics(TomlTable table) {
    KinematicParameters k;
    k.v = readChannel(table.table("v"));
    k.w = readChannel(table.table("w"));
    k.lateralPerRotation = table.number("lateral_per_rotation_m");
    table.rejectUnknown();
    return k;
}

MotionNetwork::Identified::Delay readDelay(TomlTable table) {
    MotionNetwork::Identified::Delay d;
    d.deadTime = table.number("dead_time_s", {0, 10});
    d.deadTimeError = table.number("dead_time_error_s", {0, 1e6});
    d.lag = table.number("lag_s", {0, 10});
    d.jitter = table.number("jitter_s", {0, 10});
    table.rejectUnknown();
    return d;
}

MotionNetwork::Identified readIdentified(TomlTable table) {
    MotionNetwork::Identified i;
    i.robot = table.string("robot");
    TomlTable tracker = table.table("tracker");
    i.tracker = {tracker.number("ahead_m", {-10, 10}), tracker.number("rotated_rad", {-7, 7})};
    tracker.rejectUnknown();
    i.v = readDelay(table.table("v"));
    i.w = readDelay(table.table("w"));
    i.delayed = readKinematics(table.table("delayed"));
    i.dynamic = readKinematics(table.table("dynamic"));
    table.rejectUnknown();
    return i;
}

MotionNetwork::Training readTraining(TomlTable table) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    MotionNetwork::Training t;
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

void readOutputs(TomlTable& root, MotionNetwork& network) {
    std::vector<TomlTable> tables = root.tables("outputs");
    const auto names = outputNames(network.form);
    if (tables.size() != names.size())
        root.reject("outputs",
                    "has " + std::to_string(tables.size()) + " outputs; this form has " + std::to_string(names.size()));
    for (std::size_t i = 0; i < tables.size() && i < names.size(); ++i) {
        tables[i].choice("name", {names[i]});
        NetworkOutput output;
        output.mean = tables[i].number("mean");
        output.scale = tables[i].number("scale", {1e-12, 1e12});
        tables[i].rejectUnknown();
        network.outputs.push_back(output);
    }
}

void readLayers(TomlTable table, std::size_t hidden, MotionNetwork& network) {
    const std::size_t inputs = network.inputs.size(), outputs = network.outputs.size();
    network.mlp.shape = {int(inputs), int(hidden), int(outputs)};
    constexpr NumberRange weight{-std::numeric_limits<float>::max(), std::numeric_limits<float>::max()};
    for (const auto& values :
         {table.matrix("hidden_weights", hidden, inputs, weight), table.numbers("hidden_biases", hidden, weight),
          table.matrix("output_weights", outputs, hidden, weight), table.numbers("output_biases", outputs, weight)})
        for (const double value : values) network.mlp.parameters.push_back(static_cast<float>(value));
    table.rejectUnknown();
}

MotionNetwork::HeldOut readHeldOut(TomlTable table) {
    MotionNetwork::HeldOut h;
    h.windows = table.integer("windows", 0, 1'000'000'000);
    h.horizon = table.number("horizon_s", {0, 1e6});
    h.position = table.number("position_percent");
    h.heading = table.number("heading_percent");
    if (table.has("groups")) {
        TomlTable groups = table.table("groups");
        h.groups.every = static_cast<int>(groups.integer("every", 2, 1'000'000));
        h.groups.offset = static_cast<int>(groups.integer("offset", 0, 1'000'000));
        if (h.groups.offset >= h.groups.every) groups.reject("offset", "expected less than every");
        groups.rejectUnknown();
    }
    table.rejectUnknown();
    return h;
}

void readOptionalParts(TomlTable& root, MotionNetwork& network) {
    if (root.has("wheel_phase")) {
        TomlTable table = root.table("wheel_phase");
        network.wheelPhase = {table.number("half_track_m", {0, 10}), table.number("quantum_mps", {1e-6, 10})};
        table.rejectUnknown();
    }
    if (root.has("drive")) {
        TomlTable table = root.table("drive");
        network.drive =
            DifferentialDrive{table.number("wheel_radius_m", {1e-4, 10}), table.number("track_m", {1e-3, 100})};
        table.rejectUnknown();
    }
    if (network.form == Form::history) {
        TomlTable table = root.table("recovery");
        network.recovery = {table.number("v_s", {0, 10}), table.number("w_s", {0, 10})};
        table.rejectUnknown();
    }
    if (root.has("identified"))
        for (TomlTable& table : root.tables("identified")) network.identified.push_back(readIdentified(table));
}

void checkFit(TomlTable& root, const MotionNetwork& network) {
    if (network.inputs.empty() || network.inputs.size() > MotionNetwork::maxInputs)
        root.reject("inputs", "expected 1 to " + std::to_string(MotionNetwork::maxInputs) + " inputs");
    for (const NetworkInput& input : network.inputs) {
        if (input.fromWheels() && network.wheelPhase.quantum <= 0)
            root.reject("wheel_phase", "is missing; an input needs it");
    }
}

}  // namespace

Expected<MotionNetwork> parseNetwork(std::string_view text, const std::string& file) {
    TomlTable root(text, file);
    MotionNetwork network;
    root.choice("format", {networkFormat});
    root.integer("version", MotionNetwork::version, MotionNetwork::version);
    network.form = static_cast<Form>(root.choice("form", formNames));
    network.robotType = root.string("robot_type");
    network.synthetic = root.boolean("synthetic");
    network.robots = root.strings("robots");
    network.period = fromSeconds(root.number("period_s", {0.001, 10}));
    network.turnOffset = root.number("turn_offset_radps");
    const auto hidden = static_cast<std::size_t>(root.integer("hidden", 1, std::int64_t{MotionNetwork::maxHidden}));
    for (TomlTable& input : root.tables("inputs")) network.inputs.push_back(readInput(input, network.robots));
    readOutputs(root, network);
    readOptionalParts(root, network);
    checkFit(root, network);
    network.training = readTraining(root.table("training"));
    network.heldOut = readHeldOut(root.table("held_out"));
    if (!root.failed()) readLayers(root.table("layers"), hidden, network);
    if (!root.failed()) root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    return network;
}

Expected<MotionNetwork> loadNetwork(const std::filesystem::path& path) {
    return readFile(path).and_then([&](const std::string& text) { return parseNetwork(text, path.string()); });
}

}  // namespace mrose
