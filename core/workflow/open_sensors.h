#pragma once

#include <string>
#include <vector>

#include "io/error.h"
#include "io/progress.h"
#include "logs/robot_log.h"
#include "perception/sensor_network.h"
#include "report/page.h"

namespace mrose {

/// Which learned sensor is to be held against which log.
struct EvaluateSensorRequest {
    std::string network, log;
    std::vector<std::string> robots = {};   ///< whose sensors are judged, by name; empty: all. The others occlude
    std::vector<std::string> against = {};  ///< other networks of such a sensor, beside it
    bool families = false;                  ///< the other families beside it, learned from the same logs
    std::string command = {};               ///< what a report says that it was made by
};

struct NamedSensorNetwork {
    std::string name;
    SensorNetwork network;
};

/// Whether a network file is of a sensor. Error: it cannot be read.
Expected<bool> isSensorFile(const std::string& path);
/// Whether it is of a robot's own localisation; one that is broken is not.
bool isLocaliserFile(const std::string& path);

/// Error: the file cannot be read, or its sensor measures something else.
Expected<SensorNetwork> openSensor(const std::string& path, SensorNetwork::Measures measures);

/// The networks that are compared, `first` of them, which is the request's. Error: a file; another sensor; those of
/// learnOtherFamilies().
Expected<std::vector<NamedSensorNetwork>> openSensors(const SensorNetwork& first, const EvaluateSensorRequest& request,
                                                      const Progress& learns);

/// Which of the networks of `request.against`, among those of openSensors(), were learned from the log, a sentence
/// each.
std::vector<std::string> besideNotices(const std::vector<NamedSensorNetwork>& networks,
                                       const EvaluateSensorRequest& request, const Log& log);

/// What a report says of the network.
ReportContext sensorContext(const SensorNetwork& network, const EvaluateSensorRequest& request);

}  // namespace mrose
