#include "perception/some_sensor.h"

#include <algorithm>

#include "learning/reference_network.h"
#include "perception/sensor_inputs.h"

namespace mrose::test {
namespace {

SensorNetwork camera(int components, int members = 1) {
    SensorNetwork network;
    network.sensor = "camera";
    network.robotType = "irobot-create";
    network.robots = {"1", "2"};
    network.period = 236'000'000;
    network.latency = 40'000'000;
    network.latencyError = 0.001;
    network.robotSubjects = true;
    network.view = {7.5, 1.15, 0.75};
    network.form = {2, components, members};
    network.gross = {1.0 / 1024, {2.5, 0.15}};
    network.learned.kind = SensorNetwork::kind;
    network.learned.training = {"mrose train", "irprop+", "likelihood", 1, 2, 3, {{"a.dat", "0123456789abcdef"}}};
    for (const SensorQuantity& quantity : sensorQuantities())
        network.learned.inputs.push_back({std::string(quantity.name), std::string(quantity.unit), 0.25, 0.5});
    for (const std::string& robot : network.robots)
        network.learned.inputs.push_back({robotInput(robot), std::string(robotInputUnit), 0.5, 0.5});
    network.learned.outputs = sensorOutputs(network.measures, network.form);
    return network;
}

}  // namespace

SensorNetwork someCamera(std::uint64_t seed, int members) {
    SensorNetwork network = camera(2, members);
    network.noise[0] = {0.1, 0.2, 1.5, 0.3, 7};
    network.noise[2] = {0.25, 0.125, 1.0 / 3, 0.1, 9};
    network.constant = {0.3, 0.05, {0.17, 0.011}};
    network.heldOut = {10, 20, 5, -0.4, 5.5};
    const int inputs = static_cast<int>(network.learned.inputs.size());
    Mlp mlp = normalNetwork({inputs, 9, network.form.outputs()}, static_cast<unsigned>(seed));
    for (float& parameter : mlp.parameters) parameter *= 0.3f;
    network.learned.regressor = std::move(mlp);
    for (NetworkVariable& output : network.learned.outputs) output.scale = output.unit == "rad" ? 0.01 : 0.1;
    network.learned.outputs[0].scale = 1;
    return network;
}

void makeConstant(SensorNetwork& network, const std::vector<double>& outputs) {
    network.learned.kind = SensorNetwork::kind;
    network.learned.outputs = sensorOutputs(network.measures, network.form);
    for (std::size_t i = 0; i < outputs.size(); ++i) network.learned.outputs[i].mean = outputs[i];
    Mlp mlp{{static_cast<int>(network.learned.inputs.size()), 1, network.form.outputs()}, {}};
    mlp.parameters.resize(mlp.shape.parameterCount());
    network.learned.regressor = std::move(mlp);
}

void reportAbove(SensorNetwork& network, std::size_t input, double bound) {
    network.learned.inputs[input].mean = bound;
    network.learned.outputs[0].mean = 0;  // nothing else decides
    std::vector<float>& parameters = std::get<Mlp>(network.learned.regressor).parameters;
    parameters[input] = 1000;
    parameters[network.learned.inputs.size() + 1] = 8;  // of the hidden unit to the quantile
}

SensorNetwork constantCamera(const std::vector<double>& outputs, int components) {
    SensorNetwork network = camera(components);
    network.gross = {0, {1, 1}};
    makeConstant(network, outputs);
    return network;
}

SensorNetwork constantLocalisation(const std::vector<double>& outputs) {
    SensorNetwork network = camera(1);
    network.sensor = "localisation";
    network.measures = SensorNetwork::Measures::pose;
    network.robotSubjects = false;
    network.view = {};
    network.form = {3, 1};
    network.gross = {0, {1, 1, 1}};
    network.learned.inputs.clear();
    for (const char* name : {"x", "y", "heading_sine", "heading_cosine", "speed", "rotation"}) {
        const auto quantity = std::ranges::find(sensorQuantities(), name, &SensorQuantity::name);
        network.learned.inputs.push_back({name, std::string(quantity->unit), 0, 1});
    }
    makeConstant(network, outputs);
    return network;
}

}  // namespace mrose::test
