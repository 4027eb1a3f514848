#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "io/error.h"
#include "io/value.h"
#include "logs/robot_log.h"
#include "scenario/description_source.h"
#include "world/command.h"

namespace mrose {

/// When a trajectory has both begun: to be commanded and, where it has ground truth at all, to be tracked.
Nanoseconds beginning(const Trajectory& trajectory);

/// A robot's part of a log: its commands and where it started. The log's start is the first instant at which each
/// of its robots has been commanded and tracked, so that excerpts of several robots belong together; with a trajectory
/// named it is that one's. Commands that repeat the one in force are left out. Error: no such robot or trajectory; it
/// ends before the start.
Expected<ExcerptContent> excerptOf(const Log& log, const LogExcerpt& excerpt);

/// It as a description holds it, exact to the bit, and back. nullopt: it is not such a value.
Value excerptValue(const ExcerptContent& content);
std::optional<ExcerptContent> parseExcerpt(const Value& value);

/// The same as recordings kept it before: as a CSV log with the commands of one robot, of which one row has a pose,
/// where the robot was at the run's start. Error: not such a text.
Expected<ExcerptContent> parseExcerpt(std::string_view text, const std::string& name);

}  // namespace mrose
