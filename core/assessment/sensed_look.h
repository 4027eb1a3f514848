#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "world/time.h"

namespace mrose {

/// A subject of a log as a sensor had it before it at a look, and as it was reported.
struct SensedSubject {
    std::size_t subject = 0;        ///< in Log::subjects
    double range = 0, bearing = 0;  ///< m, rad: where it truly was, from the robot, when the sensor measured
    bool inView = false;            ///< within the sensor's field of view and range, whatever hides it
    bool reported = false;
    double rangeError = 0, bearingError = 0;  ///< m, rad: what was reported, less the true one

    double reportedRange() const { return range + rangeError; }
    double reportedBearing() const;  ///< in (-pi, pi]
};

/// A look of one robot's sensor in a rollout: the real one's, or the simulated one's.
struct SensedLook {
    std::size_t request = 0, robot = 0;   ///< which rollout, whose sensor: in Comparison
    Nanoseconds time = 0;                 ///< when it measured, since the rollout's start
    std::vector<SensedSubject> subjects;  ///< those in view and those reported

    bool empty() const;  ///< nothing was reported
};

/// What a sensor may report of all that is round its robot.
struct SensorField {
    double range = 0;  ///< m; 0: without end
    double fieldOfView = 2 * std::numbers::pi,
           direction = 0;  ///< rad: about its middle, counter-clockwise from the heading

    bool holds(double distance, double bearing) const;
};

}  // namespace mrose
