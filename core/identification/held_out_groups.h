#pragma once

#include "io/error.h"
#include "learning/hold_out.h"
#include "logs/robot_log.h"

namespace mrose {

enum class LogPart { learned, heldOut };

/// The trajectories of a log that belong to one part. Robots stay, even with none. Error: no trajectory is left.
Expected<Log> partOf(Log log, const HoldOut& holdOut, LogPart part);

}  // namespace mrose
