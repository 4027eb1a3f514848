#pragma once

#include "geometry/pose.h"
#include "world/time.h"

namespace mrose {

struct StampedPose {
    Nanoseconds time = 0;
    Pose pose;  ///< heading continuous (unwrapped)
    bool operator==(const StampedPose&) const = default;
};

}  // namespace mrose
