#pragma once

#include "motion/motion_model.h"
#include "world/world_state.h"

namespace mrose {

/// Begins the way through a period of `period` seconds, from a pose and the velocity there, to what a model predicted.
MotionSegment beginSegment(const Pose& pose, const Twist& velocity_B, const MotionStep& predicted, std::int64_t tick,
                           double period);

/// Standing still.
MotionSegment restAt(const Pose& pose, std::int64_t tick);

struct PathPoint {
    Pose pose;  ///< in the world
    Twist velocity_B;
};

/// At `share` of the period, 0 ... 1; its end is the prediction exactly.
PathPoint at(const MotionSegment& segment, double share, double period);

/// The same way moved so that at `share` it passes through `pose`: how a pushed robot goes on.
void moveTo(MotionSegment& segment, double share, const Pose& pose);

}  // namespace mrose
