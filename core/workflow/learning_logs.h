#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/held_out_part.h"
#include "io/error.h"
#include "logs/robot_log.h"
#include "motion/robot_traits.h"
#include "world/differential_drive.h"

namespace mrose {

/// The logs that a network is learned from, with what is to be held out of them.
struct LearningLogs {
    std::vector<Log> logs;
    std::optional<DifferentialDrive> drive;  ///< fitted to logs of wheel commands, which are read with it
    HoldOut holdOut;

    /// What is learned from. Error: nothing is left of a log.
    Expected<std::vector<Log>> learned() const;
};

struct LearningLogsRequest {
    std::vector<std::string> sources;
    std::vector<std::string> robots;  ///< empty: all
    double holdOut = 0;               ///< the share; 0: nothing
    int holdOutPart = 0;
    HoldOutBy holdOutBy = HoldOutBy::whatSuits;
};

/// Error: a log that cannot be read, that is given twice, of another kind of robot, or that has nothing to hold out or
/// nothing else, though that was asked for.
Expected<LearningLogs> openLearningLogs(const LearningLogsRequest& request);

/// Of the kind of robot of that name, or of a robot file; "": of the one that the log names, without traits where it
/// names none. Error: no such kind.
Expected<RobotTraits> traitsOf(const std::string& kind, const Log& log);

}  // namespace mrose
