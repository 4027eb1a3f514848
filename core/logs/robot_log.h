#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"
#include "logs/measurements.h"
#include "logs/stamped_pose.h"
#include "world/command.h"
#include "world/time.h"

namespace mrose {

/// Where a tracker saw the ball: its centre, in the frame of the poses.
struct StampedBall {
    Nanoseconds time = 0;
    Point place;  ///< m
};

/// A kick that was commanded.
struct StampedKick {
    Nanoseconds time = 0;
    double power = 1;  ///< 0 ... 1
};

struct StampedVelocity {
    Nanoseconds time = 0;
    Velocity velocity;
    bool operator==(const StampedVelocity&) const = default;
};

/// What a reader found and did, so that nothing is hidden. Counts of samples unless another unit is given.
struct LogDefects {
    std::int64_t outOfOrder = 0;    ///< stamps earlier than the one before: sorted
    std::int64_t duplicates = 0;    ///< equal stamps in one file: the last one kept
    std::int64_t blips = 0;         ///< single-sample zero commands between equal moving ones: dropped
    std::int64_t poseOutliers = 0;  ///< single poses far off both neighbours: dropped
    std::int64_t ballOutliers = 0;  ///< single positions of the ball far off both neighbours: dropped
    std::int64_t unpaired = 0;      ///< values of v, w, x, y or heading alone that met no partner: dropped
    std::int64_t headingWraps = 0;  ///< jumps by whole turns: unwrapped
    std::int64_t cutLines = 0;      ///< last lines of files that are cut off: dropped
    std::int64_t commandGaps = 0;   ///< longer than LogOptions::commandGap
    std::int64_t poseGaps = 0;      ///< longer than LogOptions::poseGap
    std::int64_t ballGaps = 0;      ///< longer than LogOptions::ballGap
    double longestBallGap = 0;      ///< s
    double longestCommandGap = 0;   ///< s
    double longestPoseGap = 0;      ///< s
};

/// One stretch of one robot's life without interruption of its clock: commands sent and poses tracked, both in strictly
/// ascending time. The unit that is held out from learning.
struct Trajectory {
    std::string name;  ///< unique within its robot, for reports
    int group = 0;     ///< trajectories of one group are held out together (repetitions of one command, for example)
    bool steady =
        false;  ///< the command has been in force long enough that the motion no longer changes (Husky windows)
    std::vector<StampedCommand> commands;
    std::vector<StampedPose> poses;  ///< empty: the log has no ground truth
    /// Single zero commands that the reader dropped from `commands`, should the robot have obeyed them all the same.
    std::vector<StampedCommand> blips = {};
    /// What the robot itself measured, where the log has it: wheel speeds through the drive, and the gyro (v is 0). A
    /// prediction may use it up to its start. Like commands it may begin before the poses.
    std::vector<StampedVelocity> measuredVelocity, measuredRotation;
    std::vector<StampedKick> kicks = {};  ///< commanded to its kicker
    std::vector<StampedBall> ball = {};   ///< the tracked ball, in strictly ascending time; with one robot of a session
    std::vector<SensorLog> sensors = {};  ///< what its sensors reported, each once
};

struct RobotLog {
    std::string robot;  ///< as the format names it: "1", "husky", "pioneer-a"
    std::vector<Trajectory> trajectories;
    LogDefects defects;
};

/// What a robot is without in all of its trajectories: "commands", "ground truth"; "" where one of them has both.
inline const char* missingSide(const RobotLog& robot) {
    const char* missing = "commands";
    for (const Trajectory& trajectory : robot.trajectories) {
        if (trajectory.commands.empty()) continue;
        if (!trajectory.poses.empty()) return "";
        missing = "ground truth";
    }
    return missing;
}
inline bool hasBothSides(const RobotLog& robot) { return *missingSide(robot) == '\0'; }

struct LogFile {
    std::string path;  ///< as given
    std::string hash;  ///< contentHash of its bytes
};

/// What robots of a log, and where they drove, are called beside simulated or predicted ones.
constexpr const char* realWord(bool synthetic) { return synthetic ? "logged" : "real"; }

/// What one `LOG` argument of the program holds.
struct Log {
    std::string source;  ///< the path as given
    std::string format;  ///< "mrclam", "husky-windows", "csv"
    int dataset = 0;     ///< the number in the name of an MRCLAM folder, 0 elsewhere
    std::vector<RobotLog> robots;
    std::vector<LogFile> files;
    bool synthetic = false;  ///< made by a simulation; no real robot drove (a part of the log is enough)
    const char* real() const { return realWord(synthetic); }
    /// What should be there and is not, a sentence each: a file that is empty or missing, the end of one that is cut
    /// off, who carries a barcode, the clock of the other files. The rest is as sound as ever.
    std::vector<std::string> incomplete = {};
    /// A cause that it may explain, with the first of these sentences.
    std::string withIncomplete(std::string cause) const {
        return incomplete.empty() ? cause : std::move(cause) + ". " + incomplete.front();
    }
    std::vector<LogSubject> subjects = {};  ///< what readings are of
    /// Files of readings and subjects. They are not among `files`, by which motion networks know their logs: data sets
    /// share such files.
    std::vector<LogFile> measurementFiles = {};
};

}  // namespace mrose
