#pragma once

#include <optional>
#include <string>
#include <vector>

#include "debug/field_frame.h"

namespace mrose {

/// Something as a sensor reported it, and where it truly was.
struct ReportedSubject {
    std::string name;               ///< "create 3", "ball", "landmark 6": of the same in simulation and log
    double range = 0, bearing = 0;  ///< m; rad, counter-clockwise from the robot's heading
    std::optional<Point> truth;     ///< where it was when that was measured, in the world; nullopt: not known
};

/// What a sensor of a robot reported last.
struct SensorLook {
    std::string sensor;        ///< "camera"
    Nanoseconds measured = 0;  ///< on the run's clock
    std::optional<Pose> eye;   ///< where its robot was then; nullopt: not known
    std::vector<ReportedSubject> subjects;

    /// Where a subject is by what was reported of it; `eye` is known.
    Point reported(const ReportedSubject& subject) const;
};

/// Of each sensor of a simulated robot that reports bodies, as far as its controller reads them. Sensors whose readings
/// are of different instants have a look for each.
std::vector<SensorLook> simulatedLooks(const FieldFrame& frame, std::size_t robot);
/// Of each sensor in the log of the real robot that drove what a simulated one repeats. Stamps are taken to be as late
/// as those of the simulated robot's sensor of that name. A look is gone when no other one came for a pause and a half.
std::vector<SensorLook> realLooks(const FieldFrame& frame, std::size_t robot);

/// The sensors that have looks in that log, whenever those were.
std::vector<std::string> realLookers(const FieldFrame& frame, std::size_t robot);

}  // namespace mrose
