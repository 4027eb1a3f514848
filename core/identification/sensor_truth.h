#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "identification/level_changes.h"
#include "identification/sensor_lateness.h"
#include "logs/robot_log.h"

namespace mrose {

/// A reading of a subject of which the ground truth shows where it was.
struct KnownReading {
    std::size_t trajectory = 0;  ///< of the robot
    Nanoseconds time = 0;
    LogReading reading;
    const Trajectory* robot = nullptr;    ///< where its truth is
    const Trajectory* subject = nullptr;  ///< likewise of another robot; nullptr: a landmark
    Point landmark;
};

/// A sensor's readings that have ground truth at their stamps, in ascending time within each trajectory. They point
/// into the log. Truth of a robot that is reported is that of its trajectoryBeside() the reporting one's.
std::vector<KnownReading> knownReadings(const Log& log, const RobotLog& robot, const std::string& sensor);

/// What was reported less the true geometry a lateness [s] before the stamp; nullopt without truth at that instant.
struct ReadingMisfit {
    double range = 0, bearing = 0;  ///< m; rad, within a half turn
};
std::optional<ReadingMisfit> misfitOf(const KnownReading& known, double lateness);

/// The bearings' misfits.
LateMisfits bearingMisfits(const std::vector<KnownReading>& readings);

/// Of poses that the robot's localisation reported: how it moved forward and turned from each to one about a second
/// later, less what the truth says. No frame enters, nor a drift.
LateMisfits motionMisfits(const RobotLog& robot, const std::string& sensor);

/// How far reported poses follow the true motion: the slope of what was reported over about a second against what was
/// true, 1 where they fit and 0 where they have nothing to do with each other.
struct FollowedMotion {
    double share = 1, error = INFINITY;  ///< one standard error, from blocks of 10 s; infinite: too little motion
};
FollowedMotion followedMotion(const RobotLog& robot, const std::string& sensor, double lateness);

/// How far reported poses lie off the truth at a lateness [s] before their stamps: medians, NaN of none.
struct PoseMisfit {
    std::size_t poses = 0;                 ///< with truth
    double distance = NAN, heading = NAN;  ///< m, rad
    double exchanged = NAN;                ///< m: the distance if x and y of what was reported were exchanged
    double motion = NAN;                   ///< m that the robot moved in a second

    /// Far off as they are, and farther than stamps that are a second off explain, but near with x and y exchanged.
    bool looksExchanged() const { return distance > motion && distance > 4 * exchanged; }
};
PoseMisfit poseMisfit(const RobotLog& robot, const std::string& sensor, double lateness);

/// How the direction in which a robot moves differs from its tracked heading while it drives, every 0.5 s; a half turn
/// is left out, for it may drive backwards. It is the tracker's error where the robot cannot slip aside.
std::vector<StampedMisfit> courseMisfits(const std::vector<StampedPose>& poses);

}  // namespace mrose
