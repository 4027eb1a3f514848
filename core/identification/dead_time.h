#pragma once

#include <span>
#include <string>
#include <vector>

#include "logs/robot_log.h"

namespace mrose {

/// How one channel of a robot answers its commands in time, with how far that can be trusted.
struct ChannelDelay {
    bool identified = false;
    std::string reason;         ///< why it is not; empty when it is
    double deadTime = 0;        ///< s, mean of the single commands' dead times
    double deadTimeError = 0;   ///< s, one standard error: from blocks of 10 s and from the jitter
    double lag = 0;             ///< s, first-order time constant
    double lagError = 0;        ///< s, one standard error
    double jitter = 0;          ///< s, standard deviation of the single commands' dead times
    double jitterError = 0;     ///< s, one standard error
    double explained = 0;       ///< share of the variance of displacements within 0.16 s
    std::int64_t switches = 0;  ///< changes of the command that the truth can show
    std::int64_t windows = 0, droppedWindows = 0;

    /// "good": known to 10 ms and most of the motion explained; "fair": to 30 ms, half of it; otherwise "poor".
    std::string quality() const;
};

struct DeadTimes {
    ChannelDelay v, w;
};

/// Dead time, lag and jitter of each channel, one for all these robots' trajectories. Continuous: no sample grid
/// enters.
///
/// Displacements of the truth over short windows are compared with the closed-form displacements of delayed, lagged
/// commands; gain, bias, dead band and the slowing down in turns are fitted along. Each command has its own dead time
/// about the mean. Not identified: without truth, with fewer than 5 changes of the command, when motion does not follow
/// it, or when the standard error exceeds 0.1 s.
DeadTimes identifyDeadTimes(std::span<const RobotLog> robots);

/// For each robot of a log alone, on all processors; the result does not depend on their number.
std::vector<DeadTimes> identifyEachDeadTime(const Log& log);

}  // namespace mrose
