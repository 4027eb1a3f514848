#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/point.h"
#include "logs/stamped_pose.h"
#include "world/time.h"

namespace mrose {

/// Something that the sensors of a log can report: a landmark, or a robot, which need not have a part of the log.
struct LogSubject {
    enum class Kind { landmark, robot };
    std::string name;  ///< unique in its log: "6"
    Kind kind = Kind::landmark;
    std::string robot = {};           ///< of a robot: its name, as RobotLog::robot
    std::optional<Point> position{};  ///< of a landmark, in the frame of the poses [m]; nullopt: the log does not say
};

/// A subject as a sensor reported it.
struct LogReading {
    std::size_t subject = 0;        ///< index in Log::subjects
    double range = 0, bearing = 0;  ///< m, not negative; rad, counter-clockwise from the robot's heading
    bool operator==(const LogReading&) const = default;
};

/// One instant at which a sensor looked, with what it reported then: each subject at most once, in the order of the
/// file; nothing where it looked and saw none.
struct Look {
    Nanoseconds time = 0;  ///< as stamped: the sensor measured somewhat earlier
    std::vector<LogReading> readings;
    bool operator==(const Look&) const = default;
};

/// The ranges of one scan, at evenly spaced angles.
struct LogScan {
    Nanoseconds time = 0;
    double start = 0,
           step = 0;  ///< rad: the first ray's angle, counter-clockwise from the robot's heading; to the next
    std::vector<double> ranges;  ///< m, not negative; infinite: no echo
    bool operator==(const LogScan&) const = default;
};

/// What a reader found in the rows of one sensor and did, so that nothing is hidden.
struct SensorDefects {
    std::int64_t outOfOrder = 0;       ///< stamps earlier than the one before: sorted
    std::int64_t joinedStamps = 0;     ///< stamps so shortly after another that they are of the same look
    std::int64_t repeated = 0;         ///< of a subject in one look, or poses or scans of one stamp: the last one kept
    std::int64_t unknownSubjects = 0;  ///< readings of what the log does not name: dropped, their look kept
    std::int64_t emptyLooks = 0;       ///< looks that no row tells of and that the sensor's clock shows: added
    std::int64_t headingWraps = 0;     ///< jumps of reported headings by whole turns: unwrapped
    std::int64_t cutLines = 0;         ///< last lines of files that are cut off: dropped
};

/// What one sensor of a robot reported, on the clock of its trajectory; all in strictly ascending time. Most sensors
/// have but one of the three.
struct SensorLog {
    std::string sensor;  ///< "camera"
    std::vector<Look> looks = {};
    std::vector<StampedPose> poses = {};  ///< of the robot, as its own localisation reported them
    std::vector<LogScan> scans = {};
    SensorDefects defects = {};
};

}  // namespace mrose
