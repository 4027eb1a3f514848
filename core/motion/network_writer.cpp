#include "io/file.h"
#include "io/format.h"
#include "io/toml_text.h"
#include "learning/network_file.h"
#include "motion/motion_network.h"
#include "motion/network_words.h"

namespace mrose {
namespace {

std::string line(std::string_view key, const std::string& value) { return std::string(key) + " = " + value + '\n'; }
std::string line(std::string_view key, double value) { return line(key, numberText(value)); }

std::string readsText(const std::vector<NetworkInput>& inputs) {
    std::string text =
        "reads = [ # what the inputs are, in their order; of commands the means over a part of the history\n";
    for (const NetworkInput& input : inputs) {
        text += "  { quantity = " + tomlString(quantityNames[static_cast<std::size_t>(input.quantity)]);
        if (input.fromCommands())
            text += ", newest_s = " + numberText(input.newest) + ", oldest_s = " + numberText(input.oldest);
        if (input.quantity == NetworkInput::Quantity::robot) text += ", robot = " + tomlString(input.robot);
        text += " },\n";
    }
    return text + "]\n";
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

std::string identifiedText(const MotionNetwork::Identified& i) {
    return "\n[[motion.identified]]\n" + line("robot", tomlString(i.robot)) +
           "tracker = { ahead_m = " + numberText(i.tracker.ahead) + ", rotated_rad = " + numberText(i.tracker.rotated) +
           " }\n" + delayText("v", i.v) + delayText("w", i.w) + kinematicsText("delayed", i.delayed) +
           kinematicsText("dynamic", i.dynamic);
}

std::string heldOutErrorText(const MotionNetwork::HeldOut& h) {
    return "held_out_error = { windows = " + std::to_string(h.windows) + ", horizon_s = " + numberText(h.horizon) +
           ", position_percent = " + numberText(h.position) + ", heading_percent = " + numberText(h.heading) +
           " } # open loop, of each member on what it did not learn from\n";
}

std::string limitsText(const ActuatorLimits& limits) {
    std::string text = "\n[motion.limits] # of the drive: commands are read as it follows them\n";
    const auto add = [&](std::string_view key, double limit) {
        if (limit > 0) text += line(key, limit);
    };
    add("acceleration_v_mps2", limits.accelerationV);
    add("acceleration_w_radps2", limits.accelerationW);
    if (limits.ramps()) add("longest_ramp_s", limits.longestRamp);
    add("wheel_speed_mps", limits.wheelSpeed);
    add("half_track_m", limits.halfTrack);
    return text;
}

std::string strengthText(const ResidualNoise::Strength& s) {
    return "{ weight = " + numberText(s.weight) + ", time_s = " + numberText(s.time) + " }";
}

std::string constantNoiseText(const MotionNoise& noise) {
    return "{ distance_per_distance = " + numberText(noise.distancePerDistance) +
           ", rotation_per_rotation = " + numberText(noise.rotationPerRotation) +
           ", rotation_per_distance_radpm = " + numberText(noise.rotationPerDistance) + " }";
}

std::string traitsText(const NoiseTraits& traits) {
    std::string text;
    for (std::size_t t = 0; t < traits.size(); ++t)
        text += (t == 0 ? "{ " : ", ") + std::string(noiseTraitNames[t]) + " = " + numberText(traits[t]);
    return text + " }";
}

std::string noiseText(const ResidualNoise& noise) {
    std::string text = "\n[motion.noise] # how real runs differ from the mean\n" + line("horizon_s", noise.horizon) +
                       line("rollouts", std::to_string(noise.rollouts)) + line("scale", strengthText(noise.scale)) +
                       line("members", strengthText(noise.members)) +
                       (noise.most ? line("most", traitsText(*noise.most)) : "") +
                       (noise.constant ? line("constant", constantNoiseText(*noise.constant)) : "") +
                       "processes = [ # m or rad a period\n";
    for (const ResidualNoise::Process& process : noise.processes) {
        text += "  { axis = " + tomlString(noiseAxisNames[static_cast<std::size_t>(process.axis)]) +
                ", time_s = " + numberText(process.time);
        for (const ResidualNoise::Share& share : process.amplitude)
            text += ", " + std::string(noiseTraitNames[static_cast<std::size_t>(share.trait)]) + " = " +
                    numberText(share.weight);
        text += " },\n";
    }
    return text + "]\n";
}

std::string channelText(std::string_view name, const FamiliarDriving::Channel& c) {
    return std::string(name) + " = { newest_s = " + numberText(c.newest) + ", oldest_s = " + numberText(c.oldest) +
           ", scale = " + numberText(c.scale) + " }\n";
}

std::string familiarText(const FamiliarDriving& familiar) {
    std::string text = "\n[motion.familiar] # where the driving lies that was learned from\n" +
                       line("periods", std::to_string(familiar.periods)) + channelText("v", familiar.v) +
                       channelText("w", familiar.w) + "distances = [";
    for (const double& distance : familiar.distances)
        text += (&distance == familiar.distances.data() ? "" : ", ") + numberText(distance);
    text += "] # beyond are one in 10, 100 and 1000 of the held-out periods\nprototypes = [\n";
    for (const FamiliarDriving::Driving& prototype : familiar.prototypes) {
        text += "  [";
        for (const double& number : prototype) text += (&number == prototype.data() ? "" : ", ") + numberText(number);
        text += "],\n";
    }
    return text + "]\n";
}

std::string sectionText(const MotionNetwork& network) {
    std::string robots;
    for (const std::string& robot : network.robots) robots += (robots.empty() ? "" : ", ") + tomlString(robot);
    std::string text = "[motion]\n" + line("form", tomlString(formNames[static_cast<std::size_t>(network.form)])) +
                       line("robot_type", tomlString(network.robotType)) + line("robots", '[' + robots + ']') +
                       line("period_s", toSeconds(network.period)) + line("turn_offset_radps", network.turnOffset) +
                       readsText(network.inputs) + heldOutErrorText(network.heldOut);
    if (network.wheelPhase.quantum > 0)
        text += "\n[motion.wheel_phase]\n" + line("half_track_m", network.wheelPhase.halfTrack) +
                line("quantum_mps", network.wheelPhase.quantum);
    if (network.limits != ActuatorLimits{}) text += limitsText(network.limits);
    if (network.form == MotionNetwork::Form::history)
        text += "\n[motion.recovery] # time constants with which an unexpected velocity decays\n" +
                line("v_s", network.recovery.v) + line("w_s", network.recovery.w);
    if (network.drive)
        text += "\n[motion.drive] # fitted to the logs' wheel commands\n" +
                line("wheel_radius_m", network.drive->wheelRadius) + line("track_m", network.drive->track);
    if (network.noise) text += noiseText(*network.noise);
    if (network.familiar) text += familiarText(*network.familiar);
    for (const MotionNetwork::Identified& identified : network.identified) text += identifiedText(identified);
    return text;
}

/// All that is the same in network files of any kind.
LearnedNetwork generalPart(const MotionNetwork& network) {
    LearnedNetwork general;
    general.kind = motionKind;
    general.synthetic = network.synthetic;
    for (const NetworkInput& input : network.inputs)
        general.inputs.push_back({inputName(input), std::string(inputUnit(input)), input.mean, input.scale});
    general.outputs = outputVariables(network.form);
    general.outputs.resize(network.outputs.size());
    for (std::size_t i = 0; i < network.outputs.size(); ++i) {
        general.outputs[i].mean = network.outputs[i].mean;
        general.outputs[i].scale = network.outputs[i].scale;
    }
    general.regressor = network.mlp;
    general.members = network.members;
    general.training = network.training;
    general.holdOut = network.heldOut.part;
    return general;
}

}  // namespace

std::string networkText(const MotionNetwork& network) {
    return networkFileText(generalPart(network), sectionText(network));
}

Expected<void> saveNetwork(const MotionNetwork& network, const std::filesystem::path& path) {
    return writeFileAtomically(path, networkText(network));
}

}  // namespace mrose
