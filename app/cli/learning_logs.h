#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/error.h"
#include "learning/hold_out.h"
#include "logs/robot_log.h"
#include "world/differential_drive.h"

namespace mrose::cli {

/// What a network is learned from, without what is held out.
struct LearningLogs {
    std::vector<Log> logs;
    std::optional<DifferentialDrive> drive;  ///< fitted to logs of wheel commands, which are read with it
};

struct LearningLogsRequest {
    std::vector<std::string> sources;
    std::vector<std::string> robots;  ///< empty: all
    HoldOut holdOut;
};

/// Error: a log that cannot be read, that is given twice, of another kind of robot, or that has nothing to hold out or
/// nothing else, though that was asked for.
Expected<LearningLogs> openLearningLogs(const LearningLogsRequest& request);

/// Every n-th group, so that about `share` of them is held out; none for a share of 0.
HoldOut holdOutShare(double share, int part);

}  // namespace mrose::cli
