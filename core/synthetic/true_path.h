#pragma once

#include <span>

#include "logs/stamped_pose.h"
#include "world/command.h"

namespace mrose {

/// Where a robot truly was: sampled poses with straight lines between them. The samples must outlive it; at least two.
class TruePath {
public:
    explicit TruePath(std::span<const StampedPose> samples) : samples_(samples) {}

    Nanoseconds begin() const { return samples_.front().time; }
    Nanoseconds end() const { return samples_.back().time; }
    /// Before the first and after the last sample: that one.
    Pose at(Nanoseconds time) const;
    /// The mean over 0.1 s around `time`.
    Velocity velocityAt(Nanoseconds time) const;

private:
    std::span<const StampedPose> samples_;
};

}  // namespace mrose
