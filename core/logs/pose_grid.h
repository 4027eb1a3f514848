#pragma once

#include <vector>

#include "logs/robot_log.h"

namespace mrose {

/// Ground truth on a regular grid of instants, by a local linear fit over +-60 ms (the definition of the referee of the
/// MRCLAM windows). `start` is a whole multiple of `step`, `ok[i]` false where the truth has a gap of 0.2 s or more
/// around instant i.
struct PoseGrid {
    Nanoseconds start = 0, step = 100'000'000;
    std::vector<Pose> poses;  ///< heading continuous
    std::vector<bool> ok;

    std::size_t size() const { return poses.size(); }
    Nanoseconds time(std::size_t index) const { return start + static_cast<Nanoseconds>(index) * step; }
};

/// The grid begins 1.5 s after commands and poses have both begun and ends 1 s before one of them ends. `offset` shifts
/// it (0 <= offset < step): other phases of the same log, for learning.
PoseGrid poseGrid(const Trajectory& trajectory, Nanoseconds step = 100'000'000, Nanoseconds offset = 0);

/// Pose and velocity at `time` from the truth at or before it alone, never later: what a prediction that starts there
/// may know. False when the truth does not reach to within 0.2 s before `time`.
struct MeasuredStart {
    bool valid = false;
    Pose pose;
    Velocity velocity;
};
MeasuredStart measuredStart(const Trajectory& trajectory, Nanoseconds time);

}  // namespace mrose
