#pragma once

#include <cstddef>
#include <vector>

#include "logs/robot_log.h"

namespace mrose {

/// How a robot moved over short overlapping stretches of its ground truth. Displacement is compared with displacement,
/// so that nothing need be differentiated.
struct MotionWindows {
    struct Window {
        std::size_t from = 0, to = 0;  ///< points, each the mean of a few poses
        double along = 0;              ///< m, length of the arc along the heading
        double left = 0;               ///< m, sideways
        double rotation = 0;           ///< rad
    };
    std::vector<double> times;       ///< s after the first command, of the poses that were averaged
    std::vector<std::size_t> begin;  ///< point i is the mean of poses [begin[i], begin[i + 1])
    std::vector<Window> windows;
};

/// Windows of about `length` seconds, one from each mean of poses within `cell` seconds, from 1 s after the first
/// command to the last one. None spans a pause of the truth of 0.2 s or more. Empty without commands or truth.
MotionWindows motionWindows(const Trajectory& trajectory, double length = 0.16, double cell = 0.035);

}  // namespace mrose
