#pragma once

#include "io/error.h"
#include "learning/hold_out.h"
#include "logs/robot_log.h"

namespace mrose {

enum class LogPart { learned, heldOut };

/// Whether a trajectory's commands begin while another one of its robot was tracked that ended before it: as of windows
/// that follow each other without a pause.
bool continues(const Trajectory& trajectory, const Trajectory& other);

/// The trajectories of a log that belong to one part. Robots stay, even with none. Those to be learned from tell
/// nothing of the time of one that is held out: where they continue it, their commands begin when it has ended. Error:
/// no trajectory is left.
Expected<Log> partOf(Log log, const HoldOut& holdOut, LogPart part);

}  // namespace mrose
