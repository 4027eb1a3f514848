#pragma once

#include <numbers>
#include <utility>

#include "perception/learned_sensor.h"
#include "sensing/learned_camera.h"

namespace mrose {

/// What a camera's readings are like, whatever is true.
struct CameraReadings {
    double threshold = 8;                           ///< by which it reports: 8: always
    double rangeError = 0, rangeSpread = 1e-5;      ///< m
    double bearingError = 0, bearingSpread = 1e-5;  ///< rad
};

/// A camera network of weights zero: 4 m far and 90 degrees wide, looks every 0.236 s, 0.04 s late.
inline SensorNetwork cameraNetwork(const CameraReadings& readings = {}) {
    SensorNetwork n;
    n.sensor = "camera";
    n.robotType = "test robot";
    n.robots = {"a", "b"};
    n.period = 236'000'000;
    n.latency = 40'000'000;
    n.landmarks = n.robotSubjects = true;
    n.view = {4, std::numbers::pi / 2};
    n.gross = {0, {1, 0.5}};
    n.learned.kind = SensorNetwork::kind;
    n.learned.inputs = {{"range", "m", 2, 1}, {"clearance", "m", 0, 1}, {robotInput("a"), "1", 0, 1}};
    n.learned.outputs = sensorOutputs(n.measures, n.form);
    Mlp mlp;
    mlp.shape = {3, 1, n.form.outputs()};
    mlp.parameters.assign(mlp.shape.parameterCount(), 0);
    const double values[] = {readings.threshold, readings.rangeError, readings.bearingError,
                             std::log(readings.rangeSpread), std::log(readings.bearingSpread)};
    for (std::size_t i = 0; i < 5; ++i) mlp.parameters[mlp.parameters.size() - 5 + i] = static_cast<float>(values[i]);
    n.learned.regressor = mlp;
    n.learned.training = {"mrose train x --sensor camera -o y", "irprop+", "likelihood", 1, 100, 10, {}};
    return n;
}

/// The same that reports what is true of an input, by its number: it always does where that is well above 0, and never
/// where it is well below.
inline SensorNetwork cameraNetworkBy(std::size_t input, const CameraReadings& readings = {}) {
    SensorNetwork n = cameraNetwork(readings);
    n.learned.inputs[input].mean = 0;
    Mlp& mlp = std::get<Mlp>(n.learned.regressor);
    mlp.parameters[input] = 1000;
    mlp.parameters[4] = 8;                          // of the hidden unit to the quantile
    mlp.parameters[mlp.parameters.size() - 5] = 0;  // nothing else decides
    return n;
}

inline SensorPointer cameraOf(const SensorNetwork& network, const LearnedCamera::Options& options = {}) {
    return std::make_shared<const LearnedCamera>(std::make_shared<const LearnedSensor>(network), SensorTraits{"camera"},
                                                 options);
}

}  // namespace mrose
