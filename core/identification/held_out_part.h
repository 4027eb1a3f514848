#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/error.h"
#include "learning/hold_out.h"
#include "logs/robot_log.h"

namespace mrose {

enum class LogPart { learned, heldOut };

/// Whether a trajectory's commands begin while another one of its robot was tracked that ended before it: as of windows
/// that follow each other without a pause.
bool continues(const Trajectory& trajectory, const Trajectory& other);

/// The blocks of time, [begin, end), that are held out of a trajectory; none of one that is too short for that.
std::vector<std::pair<Nanoseconds, Nanoseconds>> heldOutBlocks(const Trajectory& trajectory, const HoldOut& holdOut);

/// The part of a log that is learned from, or the one that is held out. Robots stay, even with nothing. Blocks of time,
/// and what is left between them, are trajectories of their own under the name of the whole. The part that is learned
/// from has no data of a time that is held out: its commands begin when that has ended. The part that is held out has
/// all earlier commands. Error: nothing is left.
Expected<Log> partOf(Log log, const HoldOut& holdOut, LogPart part);

enum class HoldOutBy {
    whatSuits,  ///< groups where each log has some to hold out and some to learn from, else time
    groups,
    time
};

/// How to hold out about `share` of each log, the `part`-th of the ways to do that. No guard yet. Error: a log of which
/// that cannot be held out.
Expected<HoldOut> holdOutOf(std::span<const Log> logs, double share, int part, HoldOutBy by);

/// What no part of learning has seen, in words: "one in 5 of the groups of trajectories"; "" where it has seen all.
std::string keptFromLearning(const HoldOut& part);

}  // namespace mrose
