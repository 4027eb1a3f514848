#include <array>
#include <string_view>

#include "io/file.h"
#include "io/number_text.h"
#include "io/toml_table.h"
#include "motion/motion_network.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;
using Form = MotionNetwork::Form;

constexpr std::string_view formatName = "mrose motion network";
constexpr std::array<std::string_view, 12> quantityNames{
    "velocity_v", "velocity_w",  "robot",      "command_v",    "command_w",    "turn_sense",
    "left_sine",  "left_cosine", "right_sine", "right_cosine", "forward_sine", "forward_cosine"};
constexpr std::array<std::string_view, 5> stateOutputs{"dx_m", "dy_m", "dphi_rad", "end_v_mps", "end_w_radps"};
constexpr std::array<std::string_view, 7> historyOutputs{"dx_m",          "dy_m",      "dphi_rad",   "start_v_mps",
                                                         "start_w_radps", "end_v_mps", "end_w_radps"};

std::span<const std::string_view> outputNames(Form form) {
    return form == Form::state ? std::span<const std::string_view>(stateOutputs)
                               : std::span<const std::string_view>(historyOutputs);
}

// --- writing

/// A TOML basic string.
std::string tomlText(std::string_view text) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            (out += '\\') += c;
        else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
            ((out += "\\u00") += digits[c >> 4]) += digits[c & 15];
        else
            out += c;
    }
    return out + '"';
}

std::string line(std::string_view key, const std::string& value) { return std::string(key) + " = " + value + '\n'; }
std::string line(std::string_view key, double value) { return line(key, numberText(value)); }
std::string line(std::string_view key, std::int64_t value) { return line(key, std::to_string(value)); }

std::string inputText(const NetworkInput& input) {
    std::string text = "  { quantity = " + tomlText(quantityNames[static_cast<std::size_t>(input.quantity)]);
    const auto add = [&](std::string_view key, double value) {
        text += ", " + std::string(key) + " = " + numberText(value);
    };
    if (input.fromCommands()) {
        add("newest_s", input.newest);
        add("oldest_s", input.oldest);
    }
    if (input.quantity == Quantity::robot) text += ", robot = " + tomlText(input.robot);
    add("mean", input.mean);
    add("scale", input.scale);
    return text + " },\n";
}

std::string rowText(const float* values, int count) {
    std::string text = "[";
    for (int i = 0; i < count; ++i) text += (i ? ", " : "") + numberText(values[i]);
    return text + ']';
}

std::string layerText(const MotionNetwork& network) {
    const auto [inputs, hidden, outputs] = network.mlp.shape;
    const float* p = network.mlp.parameters.data();
    std::string text = "\n[layers]\nhidden_weights = [ # a row for each hidden unit\n";
    for (int j = 0; j < hidden; ++j, p += inputs) text += "  " + rowText(p, inputs) + ",\n";
    text += "]\nhidden_biases = " + rowText(p, hidden) + '\n';
    p += hidden;
    text += "output_weights = [ # a row for each output\n";
    for (int k = 0; k < outputs; ++k, p += hidden) text += "  " + rowText(p, hidden) + ",\n";
    return text + "]\noutput_biases = " + rowText(p, outputs) + '\n';
}

std::string delayText(std::string_view name, const MotionNetwork::Identified::Delay& d) {
    return std::string(name) + " = { dead_time_s = " + numberText(d.deadTime) +
           ", dead_time_error_s = " + numberText(d.deadTimeError) + ", lag_s = " + numberText(d.lag) +
           ", jitter_s = " + numberText(d.jitter) + " }\n";
}

std::string channelText(const KinematicParameters::Channel& c) {
    return "{ dead_time_s = " + numberText(c.deadTime) + ", lag_s = " + numberText(c.lag) +
           ", gain = " + numberText(c.gain) + ", bias = " + numberText(c.bias) + ", limit = " + numberText(c.limit) +
           ", acceleration = " + numberText(c.acceleration) + " }";
}

std::string kinematicsText(std::string_view name, const KinematicParameters& k) {
    return std::string(name) + " = { v = " + channelText(k.v) + ", w = " + channelText(k.w) +
           ", lateral_per_rotation_m = " + numberText(k.lateralPerRotation) + " }\n";
}

std::string provenanceText(const MotionNetwork& network) {
    const auto& t = network.training;
    std::string text = "\n[training]\n" + line("command", tomlText(t.command)) + line("method", tomlText(t.method)) +
                       line("loss", tomlText(t.loss)) + line("seed", static_cast<std::int64_t>(t.seed)) +
                       line("patterns", t.patterns) + line("epochs", t.epochs) + "logs = [\n";
    for (const auto& log : t.logs)
        text += "  { path = " + tomlText(log.path) + ", xxh3 = " + tomlText(log.hash) + " },\n";
    const auto& h = network.heldOut;
    text += "]\n\n[held_out] # open-loop errors on trajectories that were not learned from\n" +
            line("windows", h.windows) + line("horizon_s", h.horizon) + line("position_percent", h.position) +
            line("heading_percent", h.heading);
    if (h.groups.holdsAny())
        text += "groups = { every = " + std::to_string(h.groups.every) +
                ", offset = " + std::to_string(h.groups.offset) + " } # never seen: group % every == offset\n";
    for (const auto& i : network.identified)
        text += "\n[[identified]]\n" + line("robot", tomlText(i.robot)) +
                "tracker = { ahead_m = " + numberText(i.tracker.ahead) +
                ", rotated_rad = " + numberText(i.tracker.rotated) + " }\n" + delayText("v", i.v) +
                delayText("w", i.w) + kinematicsText("delayed", i.delayed) + kinematicsText("dynamic", i.dynamic);
    return text;
}

// --- reading

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

std::string networkText(const MotionNetwork& network) {
    const auto text = [](const std::vector<std::string>& values) {
        std::string out = "[";
        for (const std::string& value : values) out += (out.size() > 1 ? ", " : "") + tomlText(value);
        return out + ']';
    };
    std::string out = "# A motion model learned by mrose; nets/README.md explains the keys.\n";
    out += line("format", tomlText(formatName)) + line("version", std::int64_t{MotionNetwork::version}) +
           line("form", network.form == Form::state ? "\"state\"" : "\"history\"") +
           line("robot_type", tomlText(network.robotType)) + line("synthetic", network.synthetic ? "true" : "false") +
           line("robots", text(network.robots)) + line("period_s", toSeconds(network.period)) +
           line("hidden", std::int64_t{network.mlp.shape.hidden}) + line("turn_offset_radps", network.turnOffset);
    out += "inputs = [ # the network reads (value - mean) / scale\n";
    for (const NetworkInput& input : network.inputs) out += inputText(input);
    out += "]\noutputs = [ # the value is mean + scale * output\n";
    const auto names = outputNames(network.form);
    for (std::size_t i = 0; i < network.outputs.size(); ++i)
        out += "  { name = " + tomlText(names[i]) + ", mean = " + numberText(network.outputs[i].mean) +
               ", scale = " + numberText(network.outputs[i].scale) + " },\n";
    out += "]\n";
    if (network.wheelPhase.quantum > 0)
        out += "\n[wheel_phase]\n" + line("half_track_m", network.wheelPhase.halfTrack) +
               line("quantum_mps", network.wheelPhase.quantum);
    if (network.form == Form::history)
        out += "\n[recovery] # time constants with which an unexpected velocity decays\n" +
               line("v_s", network.recovery.v) + line("w_s", network.recovery.w);
    if (network.drive)
        out += "\n[drive] # fitted to the logs' wheel commands\n" + line("wheel_radius_m", network.drive->wheelRadius) +
               line("track_m", network.drive->track);
    return out + provenanceText(network) + layerText(network);
}

Expected<MotionNetwork> parseNetwork(std::string_view text, const std::string& file) {
    TomlTable root(text, file);
    MotionNetwork network;
    root.choice("format", {formatName});
    root.integer("version", MotionNetwork::version, MotionNetwork::version);
    network.form = root.choice("form", {"state", "history"}) == 0 ? Form::state : Form::history;
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

Expected<void> saveNetwork(const MotionNetwork& network, const std::filesystem::path& path) {
    return writeFileAtomically(path, networkText(network));
}

}  // namespace mrose
