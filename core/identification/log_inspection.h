#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "identification/dead_time.h"
#include "identification/sensor_inspection.h"
#include "logs/robot_log.h"

namespace mrose {

/// From the least to the most of some numbers; empty(): there were none.
struct MeasuredRange {
    double least = INFINITY, most = -INFINITY;
    void add(double x);
    bool empty() const { return !std::isfinite(least); }
};

/// What a log holds of one robot, in figures.
struct RobotInspection {
    std::string robot;
    std::size_t trajectories = 0, commands = 0, poses = 0;
    double commandTime = 0, poseTime = 0;  ///< s, from first to last, summed over trajectories
    MeasuredRange v, w;                    ///< of the commands, m/s and rad/s
    MeasuredRange x, y;                    ///< of the poses, m
    std::size_t ball = 0, kicks = 0;       ///< positions of the ball, commanded kicks
    double ballTime = 0;                   ///< s, as of the poses
    MeasuredRange kickPower;
    LogDefects defects;
    DeadTimes delays;
    std::vector<SensorInspection> sensors = {};

    double commandRate() const;  ///< Hz; 0 where it has none
    double poseRate() const;
    double ballRate() const;
};

/// What a log holds.
struct LogInspection {
    std::string source, format;
    bool synthetic = false;
    std::vector<LogFile> files;
    std::vector<std::string> incomplete;  ///< as Log::incomplete
    std::vector<std::string> unitDoubts;  ///< what looks like other units, a sentence each
    std::vector<RobotInspection> robots;
    std::vector<LogFile> measurementFiles = {};  ///< as Log::measurementFiles

    bool hasMeasurements() const;
};

/// Counts, and identifies each robot's dead times and how late its sensors are; on all processors.
LogInspection inspect(const Log& log);

/// One of the counts of what a reader found and did, with its name in files and its words.
struct DefectCount {
    std::int64_t LogDefects::*count;
    const char *key, *one, *many, *done;
};
std::span<const DefectCount> defectCounts();

}  // namespace mrose
