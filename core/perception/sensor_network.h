#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "learning/learned_network.h"
#include "perception/constant_noise.h"
#include "perception/reading_distribution.h"
#include "perception/reading_noise.h"
#include "perception/view.h"
#include "world/time.h"

namespace mrose {

/// A learned sensor as a value: everything that its file holds. nets/README.md explains the file.
struct SensorNetwork {
    static constexpr const char* kind = "sensor";  ///< of its network files

    enum class Measures {
        subjects,  ///< range and bearing of landmarks and robots
        pose       ///< the robot's own pose; errors are in the robot's frame
    };

    std::string sensor;  ///< what logs call it: "camera"
    Measures measures = Measures::subjects;
    std::string robotType;                         ///< "irobot-create"
    std::vector<std::string> robots;               ///< whose sensors are told apart
    Nanoseconds period = 0;                        ///< of its looks; 0: not known
    Nanoseconds latency = 0;                       ///< from the measurement to the stamp
    double latencyError = 0;                       ///< s, standard error
    bool landmarks = true, robotSubjects = false;  ///< what it reports
    View view;                                     ///< of subjects
    ReadingForm form;
    GrossErrors gross;
    ReadingNoises noise;
    ConstantNoise constant;  ///< of an ideal sensor, from the same readings

    /// What it is about what it did not learn from: mean logarithms of likelihoods.
    struct HeldOut {
        std::int64_t looks = 0, cases = 0, readings = 0;
        double reported = 0;  ///< by case: whether there was a reading
        double error = 0;     ///< by reading: density of its errors
        bool operator==(const HeldOut&) const = default;
    };
    HeldOut heldOut;

    LearnedNetwork learned;  ///< its inputs are those of sensor_inputs.h, its outputs those of `form`
    bool operator==(const SensorNetwork&) const = default;
};

/// "mean error of the range" ... by ReadingForm: the outputs' names and units, with mean 0 and scale 1.
std::vector<NetworkVariable> sensorOutputs(SensorNetwork::Measures measures, const ReadingForm& form);

/// What a sensor measures, by dimension: "range", "m".
struct ReadingDimension {
    std::string_view name, unit;
};
std::span<const ReadingDimension> dimensionsOf(SensorNetwork::Measures measures);

/// The text of a network file (`learning/network_file.h`) and back, exact to the bit. Error: file, line and key of what
/// does not fit, another kind of network.
std::string sensorText(const SensorNetwork& network);
Expected<SensorNetwork> parseSensor(std::string_view text, const std::string& file);

Expected<SensorNetwork> loadSensor(const std::filesystem::path& path);
Expected<void> saveSensor(const SensorNetwork& network, const std::filesystem::path& path);

}  // namespace mrose
