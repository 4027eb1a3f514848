#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "io/error.h"
#include "logs/robot_log.h"
#include "scenario/description_source.h"
#include "world/command.h"

namespace mrose {

/// When a trajectory has both begun: to be commanded and, where it has ground truth at all, to be tracked.
Nanoseconds beginning(const Trajectory& trajectory);

/// The text of an excerpt, as DescriptionSource::excerpt gives it. The log's start is the first instant at which each
/// of its robots has been commanded and tracked, so that excerpts of several robots belong together; with a trajectory
/// named it is that one's. Commands that repeat the one in force are left out. Error: no such robot or trajectory; it
/// ends before the start.
Expected<std::string> excerptText(const Log& log, const LogExcerpt& excerpt);

/// What it says.
struct ExcerptContent {
    std::vector<StampedCommand> commands;  ///< times count from the run's start; some may lie before
    std::optional<Pose> start;             ///< none: the log has no ground truth
};
/// Error: not such a text.
Expected<ExcerptContent> parseExcerpt(std::string_view text, const std::string& name);

}  // namespace mrose
