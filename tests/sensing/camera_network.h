#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "perception/learned_sensor.h"
#include "perception/some_sensor.h"
#include "sensing/learned_camera.h"

namespace mrose {

/// What a camera's readings are like, whatever is true.
struct CameraReadings {
    double threshold = 8;                           ///< by which it reports: 8: always
    double rangeError = 0, rangeSpread = 1e-5;      ///< m
    double bearingError = 0, bearingSpread = 1e-5;  ///< rad
};

/// A constant camera network: 4 m far and 90 degrees wide, looks every 0.236 s, 0.04 s late.
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
    n.learned.inputs = {{"range", "m", 2, 1}, {"clearance", "m", 0, 1}, {robotInput("a"), "1", 0, 1}};
    test::makeConstant(n, {readings.threshold, readings.rangeError, readings.bearingError,
                           std::log(readings.rangeSpread), std::log(readings.bearingSpread)});
    n.learned.training = {"mrose train x --sensor camera -o y", "irprop+", "likelihood", 1, 100, 10, {}};
    return n;
}

/// The same that reports where an input, by its number, is above 0.
inline SensorNetwork cameraNetworkBy(std::size_t input, const CameraReadings& readings = {}) {
    SensorNetwork n = cameraNetwork(readings);
    test::reportAbove(n, input, 0);
    return n;
}

inline SensorPointer cameraOf(const SensorNetwork& network, const LearnedCamera::Options& options = {}) {
    return std::make_shared<const LearnedCamera>(std::make_shared<const LearnedSensor>(network), SensorTraits{"camera"},
                                                 options);
}

}  // namespace mrose
