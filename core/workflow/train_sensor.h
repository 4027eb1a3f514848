#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "identification/sensor_trainer.h"
#include "io/progress.h"

namespace mrose {

/// From which logs a sensor is learned, and how. What is left open is as SensorTrainerOptions say.
struct TrainSensorRequest {
    std::vector<std::string> logs;
    std::string sensor;                    ///< its name in the logs
    std::string output;                    ///< the network file; empty: it is written nowhere
    bool overwrite = false;                ///< of a file that is there already
    std::vector<std::string> robots = {};  ///< whose sensors; empty: of all. The others are seen and occlude
    std::string robotKind = {};            ///< a name or a robot file; empty: what the log says
    std::optional<double> latency = {};    ///< s; otherwise identified, by all robots and logs
    SensorTrainerOptions training = {};
    std::string command = {};  ///< what the network says that it was made by
};

struct TrainedSensor {
    SensorNetwork network;
    std::vector<std::string> notices = {};  ///< what must be known of it, a sentence each
};

/// Reads the logs, learns, and writes the network: of subjects where the sensor reported readings, else of its robot's
/// own pose. Error: of the logs, openLog(); one without measurements, without such a sensor or robot; a sensor of
/// scans; most readings are far off the ground truth; the file cannot be written, is there already or one of the logs;
/// too little to learn from; `progress` ended it.
Expected<TrainedSensor> trainSensor(const TrainSensorRequest& request, const Progress& progress = {});

}  // namespace mrose
