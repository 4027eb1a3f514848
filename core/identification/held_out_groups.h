#pragma once

#include "io/error.h"
#include "logs/robot_log.h"
#include "motion/group_hold_out.h"

namespace mrose {

enum class LogPart { learned, heldOut };

/// The trajectories of a log that belong to one part. Robots stay, even with none. Error: no trajectory is left.
Expected<Log> partOf(Log log, const GroupHoldOut& holdOut, LogPart part);

}  // namespace mrose
