#include "io/file.h"
#include "io/number_text.h"
#include "motion/motion_network.h"
#include "motion/network_words.h"

namespace mrose {
namespace {

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
    if (input.quantity == NetworkInput::Quantity::robot) text += ", robot = " + tomlText(input.robot);
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

}  // namespace

std::string networkText(const MotionNetwork& network) {
    const auto text = [](const std::vector<std::string>& values) {
        std::string out = "[";
        for (const std::string& value : values) out += (out.size() > 1 ? ", " : "") + tomlText(value);
        return out + ']';
    };
    std::string out = "# A motion model learned by mrose; nets/README.md explains the keys.\n";
    out += line("format", tomlText(networkFormat)) + line("version", std::int64_t{MotionNetwork::version}) +
           line("form", tomlText(formNames[static_cast<std::size_t>(network.form)])) +
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
    if (network.form == MotionNetwork::Form::history)
        out += "\n[recovery] # time constants with which an unexpected velocity decays\n" +
               line("v_s", network.recovery.v) + line("w_s", network.recovery.w);
    if (network.drive)
        out += "\n[drive] # fitted to the logs' wheel commands\n" + line("wheel_radius_m", network.drive->wheelRadius) +
               line("track_m", network.drive->track);
    return out + provenanceText(network) + layerText(network);
}

Expected<void> saveNetwork(const MotionNetwork& network, const std::filesystem::path& path) {
    return writeFileAtomically(path, networkText(network));
}

}  // namespace mrose
