#pragma once

#include "behaviour/floor_plan.h"
#include "geometry/point.h"

namespace mrose {

/// What a ball rolls on, as far as a robot knows it.
struct BallFloor {
    const FloorPlan* walls = nullptr;  ///< none: there are no walls
    double ballRadius = 0.11;          ///< m
};

/// A ball that nothing touches but the floor and walls: it gets slower, and rolls on along the walls that it meets. How
/// far it bounces a robot does not know, and sees soon.
struct RollingBall {
    Point position, velocity;  ///< m, m/s

    RollingBall after(double seconds, const BallFloor& floor) const;
};

}  // namespace mrose
