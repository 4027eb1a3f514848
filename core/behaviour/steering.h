#pragma once

#include <functional>

#include "behaviour/motion_memory.h"
#include "control/observation.h"
#include "geometry/point.h"

namespace mrose {

struct DriveLimits {
    double speed = 0.4;   ///< m/s
    double rotation = 1;  ///< rad/s
};

/// How fast to turn for an angle that is left, 1/s.
constexpr double turnGain = 2;

/// Towards a point in the own frame, at full speed once it lies ahead; turns on the spot where it lies far aside.
Command driveTowards(const Point& target_B, const DriveLimits& limits);

/// One step of a smooth way to a pose that slows down towards it: the law of Park and Kuipers (2011), which turns the
/// robot exponentially to the heading that leads to the pose, made to head straight for poses farther than about a
/// metre. `backwards`: tail first.
Command driveToPose(const Pose& from, const Pose& goal, const DriveLimits& limits, bool backwards);

/// The heading (rad) nearest to `wanted`, to the right first, whose way is free for `far` metres, as `freeWay` gives
/// for any heading; where there is none within 135 degrees, the one whose way is free the longest.
double clearHeading(double wanted, double far, const std::function<double(double)>& freeWay);

/// How to give way to the nearest body that is seen ahead.
struct Evasion {
    double turn = 0;   ///< rad, to the left: what it takes to pass it at some distance; 0: nothing is in the way
    double share = 1;  ///< of the intended speed
};
/// For bodies within 1.5 m before the robot as it will be in `deadTime` seconds. Robots that meet head on keep
/// to the right.
Evasion evade(std::span<const SeenBody> bodies, const MotionMemory& motion, double deadTime);

/// A command with the evasion in it.
Command evading(const Command& intended, const Evasion& evasion, const DriveLimits& limits);

}  // namespace mrose
