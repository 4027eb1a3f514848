#pragma once

#include <optional>
#include <string>
#include <vector>

#include "logs/robot_log.h"

namespace mrose {

/// A row of a file of readings; without a reading it says no more than that the sensor looked.
struct StampedReading {
    Nanoseconds time = 0;
    std::optional<LogReading> reading;
};

/// Readings, in the order of the file, as looks: sorted by time (stable), those stamped at most `same` after the first
/// of a look are of that look. Of a subject's readings in one look the last is kept.
std::vector<Look> joinLooks(std::vector<StampedReading> readings, Nanoseconds same, SensorDefects& defects);

/// More looks than that between two others are not added: the sensor paused.
inline constexpr int mostEmptyLooks = 7;

/// Adds the looks that saw nothing and left no row: where two looks are 2 to 8 `period`s apart, to 12 ms a period, the
/// sensor looked between them too. Their instants, to the millisecond, divide that time evenly. The definition of the
/// referee of learned cameras on the MRCLAM logs.
void addEmptyLooks(std::vector<Look>& looks, double period, SensorDefects& defects);

/// What is wrong with a range [m] or a bearing [rad], and what is expected; "": nothing.
std::string wrongRange(double range);
std::string wrongBearing(double bearing);

/// Reported poses and scans: sorted by time (stable), the last of equal stamps kept; headings unwrapped.
void conditionReported(std::vector<StampedPose>& poses, SensorDefects& defects);
void conditionReported(std::vector<LogScan>& scans, SensorDefects& defects);

/// Whether the time from a sensor's first to its last report shares a part with that of the trajectory's commands and
/// poses.
bool sharesTime(const SensorLog& sensor, const Trajectory& trajectory);
/// What to say where it does not.
std::string otherTimeCause(const SensorLog& sensor, const Trajectory& trajectory);

}  // namespace mrose
