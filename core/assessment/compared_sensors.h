#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assessment/log_world.h"
#include "assessment/sensed_look.h"
#include "control/reading.h"

namespace mrose {

class Sensor;

/// A sensor of this name that simulated robots have, and of which the log has looks: cameras that report landmarks and
/// robots.
struct SensorPair {
    std::string name;
    std::vector<std::shared_ptr<const Sensor>> sensors;  ///< by compared robot; null: there is no such pair
    SensorField field;                                   ///< that holds all of theirs

    /// The readings whose records are SeenBody: "camera.landmarks", "camera.robots".
    ReadingName landmarks() const { return name + ".landmarks"; }
    ReadingName robots() const { return name + ".robots"; }
};

/// In the order of their names; none of a log without readings, and none of robots without sensors.
std::vector<SensorPair> sensorPairs(const LogWorld& world);
bool gives(const Sensor& sensor, const ReadingName& reading);
SensorField fieldOf(const Sensor& sensor);

/// Which subjects of the log an opened world has, and what they are in it.
struct WorldSubjects {
    std::vector<std::optional<Point>> landmarks;           ///< by subject: where it is in the world
    std::vector<std::optional<std::size_t>> robots;        ///< by subject: in Comparison::robots
    std::vector<std::optional<std::size_t>> ofLandmark;    ///< by landmark of the environment: the subject
    std::vector<std::optional<std::size_t>> ofSceneRobot;  ///< by robot of the scene: the subject

    WorldSubjects(const LogWorld& world, const LogWorld::Opened& opened);
};

}  // namespace mrose
