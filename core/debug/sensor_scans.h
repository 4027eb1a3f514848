#pragma once

#include <vector>

#include "debug/field_frame.h"
#include "sensing/sensor.h"

namespace mrose {

/// What a sensor whose elements measure their robot's surroundings gave last.
struct SensorScan {
    enum class Kind { laser, sonar, infrared, bumpers, lineCamera };

    Kind kind = Kind::laser;
    NewestReading known;  ///< a record for each element
    std::vector<SensorElement> elements;
    Pose eye;  ///< of its robot when that was measured
};

/// What kind of scans a sensor gives; nullopt: none.
std::optional<SensorScan::Kind> scanKind(const Sensor& sensor);
bool isScan(const NewestReading& known);

/// Those of a robot whose places are known, in the order of its sensors.
std::vector<SensorScan> scansOf(const FieldFrame& frame, std::size_t robot);

}  // namespace mrose
