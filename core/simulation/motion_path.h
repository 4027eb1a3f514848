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
    Pose pose;
    Twist velocity_B;
};

/// At `share` of the period, 0 ... 1, as seen from the segment's start; its end is the prediction exactly.
PathPoint fromStart(const MotionSegment& segment, double share, double period);

/// The same in the world.
PathPoint at(const MotionSegment& segment, double share, double period);

/// A robot that has been pushed has another velocity than its way: its wheels bring it back to that, as fast as
/// traction allows. `now` is where it is, `next` the way's point after `duration` seconds (from the way's point `onWay`
/// before); the result is where it gets, and whether it is still off the way's velocity then. `turnLever` in 1/m: the
/// rotation that a force per mass at the wheels gives.
struct Recovery {
    PathPoint point;
    bool recovering = false;
};
Recovery recover(const PathPoint& now, const PathPoint& onWay, const PathPoint& next, double duration, double traction,
                 double turnLever);

/// The same way moved so that at `share` it passes through `pose`: how a pushed robot goes on.
void moveTo(MotionSegment& segment, double share, const Pose& pose);

}  // namespace mrose
