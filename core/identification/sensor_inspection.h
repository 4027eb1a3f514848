#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "identification/level_changes.h"
#include "identification/sensor_lateness.h"
#include "identification/sensor_truth.h"
#include "logs/robot_log.h"

namespace mrose {

/// A stretch over which a sensor's readings were off as they usually are not.
struct SensorChange {
    enum class Cause {
        unknown,  ///< the robot did not drive enough to say
        sensor,   ///< its tracked heading was as usual
        truth     ///< its tracked heading was off by as much: the ground truth changed, not the sensor
    };
    bool bearing = true;  ///< offsets in rad; otherwise the range: as a share of it
    std::string trajectory = {};
    double begin = 0, end = 0;                  ///< s after the trajectory's first command or pose
    std::size_t index = 0;                      ///< of the trajectory
    Nanoseconds firstStamp = 0, lastStamp = 0;  ///< of the readings that were off
    double offset = 0, error = 0;  ///< what is reported, from its usual difference to the truth; one standard error
    Cause cause = Cause::unknown;
    double headingOffset = 0, headingError = 0;  ///< rad: of the tracked heading by the direction of motion; 0: unknown
};

/// What one sensor of a robot reported, in figures.
struct SensorInspection {
    std::string sensor;
    std::size_t looks = 0, seeingLooks = 0, readings = 0, subjects = 0, landmarkReadings = 0, poses = 0, scans = 0;
    double period = 0, periodSpread = 0;  ///< s: median between its reports, and robust spread; 0: of too few
    SensorDefects defects;
    std::size_t known = 0, gross = 0;  ///< readings beside ground truth; those more than 1 m or 0.15 rad off it
    /// m and rad, medians and robust spreads of those that are known and not gross, at the lateness; NaN of none.
    double rangeOffset = NAN, rangeSpread = NAN, bearingOffset = NAN, bearingSpread = NAN;
    SensorLateness lateness;
    /// Of reported poses the share of the true motion that they follow, where that is known to be less than half.
    std::optional<double> followed;
    PoseMisfit pose;                    ///< of reported poses, at the lateness
    std::vector<SensorChange> changes;  ///< in ascending time within each trajectory

    /// Readings that are mostly gross, poses that do not follow the motion or lie elsewhere.
    bool misfits() const { return 2 * gross > known || followed || pose.looksExchanged(); }
    double grossShare() const { return known > 0 ? static_cast<double>(gross) / static_cast<double>(known) : 0; }
};

/// Whether a reading is so far off, in m and rad, that it is an error of another kind than noise.
bool isGross(double range, double bearing);

/// Of poses that look so: how far off they are, as they are and with x and y exchanged.
std::string exchangedText(const PoseMisfit& pose);

/// Of the sensor of that name.
SensorInspection inspectSensor(const Log& log, const RobotLog& robot, const std::string& name);
/// Of each sensor of a robot of the log, in the order of its trajectories.
std::vector<SensorInspection> inspectSensors(const Log& log, const RobotLog& robot);

}  // namespace mrose
