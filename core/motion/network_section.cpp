#include "motion/network_section.h"

#include <algorithm>

#include "motion/network_words.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;
using Form = MotionNetwork::Form;

KinematicParameters::Channel readKinematicChannel(TomlTable table) {
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

KinematicParameters readKinematicParameters(TomlTable table) {
    KinematicParameters k;
    k.v = readKinematicChannel(table.table("v"));
    k.w = readKinematicChannel(table.table("w"));
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

MotionNetwork::Identified readIdentified(TomlTable& table) {
    MotionNetwork::Identified i;
    i.robot = table.string("robot");
    TomlTable tracker = table.table("tracker");
    i.tracker = {tracker.number("ahead_m", {-10, 10}), tracker.number("rotated_rad", {-7, 7})};
    tracker.rejectUnknown();
    i.v = readDelay(table.table("v"));
    i.w = readDelay(table.table("w"));
    i.delayed = readKinematicParameters(table.table("delayed"));
    i.dynamic = readKinematicParameters(table.table("dynamic"));
    table.rejectUnknown();
    return i;
}

ActuatorLimits readLimits(TomlTable table) {
    ActuatorLimits limits;
    if (table.has("acceleration_v_mps2")) limits.accelerationV = table.number("acceleration_v_mps2", {1e-6, 1e6});
    if (table.has("acceleration_w_radps2")) limits.accelerationW = table.number("acceleration_w_radps2", {1e-6, 1e6});
    if (limits.ramps() && table.has("longest_ramp_s"))
        limits.longestRamp = table.number("longest_ramp_s", {1e-3, ActuatorLimits::mostRamp});
    if (table.has("wheel_speed_mps")) {
        limits.wheelSpeed = table.number("wheel_speed_mps", {1e-6, 1e6});
        limits.halfTrack = table.number("half_track_m", {1e-3, 10});
    }
    table.rejectUnknown();
    return limits;
}

ResidualNoise::Strength readStrength(TomlTable table) {
    ResidualNoise::Strength s;
    s.weight = table.number("weight", {0, 1e3});
    s.time = table.number("time_s", {0, 1e6});
    table.rejectUnknown();
    return s;
}

MotionNoise readConstantNoise(TomlTable table) {
    MotionNoise noise;
    noise.distancePerDistance = table.number("distance_per_distance", {0, 1e3});
    noise.rotationPerRotation = table.number("rotation_per_rotation", {0, 1e3});
    noise.rotationPerDistance = table.number("rotation_per_distance_radpm", {0, 1e3});
    table.rejectUnknown();
    return noise;
}

NoiseTraits readTraits(TomlTable table) {
    NoiseTraits traits;
    for (std::size_t t = 0; t < traits.size(); ++t) traits[t] = table.number(noiseTraitNames[t], {0, 1e6});
    table.rejectUnknown();
    return traits;
}

ResidualNoise readNoise(TomlTable table) {
    ResidualNoise noise;
    noise.horizon = table.number("horizon_s", {0, 1e6});
    noise.rollouts = table.integer("rollouts", 0, 1'000'000'000);
    noise.scale = readStrength(table.table("scale"));
    noise.members = readStrength(table.table("members"));
    if (table.has("most")) noise.most = readTraits(table.table("most"));
    if (table.has("constant")) noise.constant = readConstantNoise(table.table("constant"));
    for (TomlTable& part : table.tables("processes")) {
        ResidualNoise::Process process;
        process.axis = static_cast<ResidualNoise::Axis>(part.choice("axis", noiseAxisNames));
        process.time = part.number("time_s", {0, 1e6});
        for (std::size_t t = 0; t < noiseTraitNames.size(); ++t)
            if (part.has(noiseTraitNames[t]))
                process.amplitude.push_back({static_cast<NoiseTrait>(t), part.number(noiseTraitNames[t], {0, 1e3})});
        part.rejectUnknown();
        noise.processes.push_back(std::move(process));
    }
    if (noise.processes.size() > ResidualNoise::maxProcesses)
        table.reject("processes", "has " + std::to_string(noise.processes.size()) + " elements; expected at most " +
                                      std::to_string(ResidualNoise::maxProcesses));
    table.rejectUnknown();
    return noise;
}

FamiliarDriving::Channel readFamiliarChannel(TomlTable table) {
    FamiliarDriving::Channel channel;
    channel.newest = table.number("newest_s", {0, 10});
    channel.oldest = table.number("oldest_s", {0, 10});
    if (channel.oldest <= channel.newest) table.reject("oldest_s", "expected more than newest_s");
    channel.scale = table.number("scale", {1e-6, 1e6});
    table.rejectUnknown();
    return channel;
}

FamiliarDriving readFamiliar(TomlTable table) {
    FamiliarDriving familiar;
    familiar.periods = table.integer("periods", 1, 1'000'000'000);
    familiar.v = readFamiliarChannel(table.table("v"));
    familiar.w = readFamiliarChannel(table.table("w"));
    const std::vector<double> distances = table.numbers("distances", familiar.distances.size(), {1e-6, 1e6});
    for (std::size_t i = 0; i < distances.size() && i < familiar.distances.size(); ++i) {
        familiar.distances[i] = distances[i];
        if (i > 0 && distances[i] < distances[i - 1]) table.reject("distances", "expected ascending numbers");
    }
    constexpr std::size_t width = FamiliarDriving::numbers;
    const std::vector<double> rows = table.rows("prototypes", width, 1, FamiliarDriving::mostPrototypes, {-1e6, 1e6});
    for (std::size_t i = 0; i + width <= rows.size(); i += width) {
        familiar.prototypes.emplace_back();
        std::copy_n(&rows[i], width, familiar.prototypes.back().begin());
    }
    table.rejectUnknown();
    return familiar;
}

}  // namespace

void readMotionBasics(TomlTable& table, MotionNetwork& network) {
    network.form = static_cast<Form>(table.choice("form", formNames));
    network.robotType = table.string("robot_type");
    network.robots = table.strings("robots");
    network.period = fromSeconds(table.number("period_s", {0.001, 10}));
    network.turnOffset = table.number("turn_offset_radps");
}

void readMotionParts(TomlTable& table, MotionNetwork& network) {
    if (table.has("wheel_phase")) {
        TomlTable part = table.table("wheel_phase");
        network.wheelPhase = {part.number("half_track_m", {0, 10}), part.number("quantum_mps", {1e-6, 10})};
        part.rejectUnknown();
    }
    if (table.has("limits")) network.limits = readLimits(table.table("limits"));
    if (table.has("drive")) {
        TomlTable part = table.table("drive");
        network.drive =
            DifferentialDrive{part.number("wheel_radius_m", {1e-4, 10}), part.number("track_m", {1e-3, 100})};
        part.rejectUnknown();
    }
    if (network.form == Form::history) {
        TomlTable part = table.table("recovery");
        network.recovery = {part.number("v_s", {0, 10}), part.number("w_s", {0, 10})};
        part.rejectUnknown();
    }
    if (table.has("noise")) network.noise = readNoise(table.table("noise"));
    if (table.has("familiar")) network.familiar = readFamiliar(table.table("familiar"));
    if (table.has("identified"))
        for (TomlTable& part : table.tables("identified")) network.identified.push_back(readIdentified(part));
}

NetworkInput readNetworkInput(TomlTable& table, const std::vector<std::string>& robots) {
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
    return input;
}

void readHeldOutError(TomlTable& table, MotionNetwork::HeldOut& heldOut) {
    heldOut.windows = table.integer("windows", 0, 1'000'000'000);
    heldOut.horizon = table.number("horizon_s", {0, 1e6});
    heldOut.position = table.number("position_percent");
    heldOut.heading = table.number("heading_percent");
}

void checkMotionInputs(TomlTable& table, const MotionNetwork& network) {
    for (const NetworkInput& input : network.inputs)
        if (input.fromWheels() && network.wheelPhase.quantum <= 0)
            table.reject("wheel_phase", "is missing; an input needs it");
}

}  // namespace mrose
