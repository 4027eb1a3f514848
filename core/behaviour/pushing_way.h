#pragma once

#include <vector>

#include "behaviour/floor_plan.h"

namespace mrose {

/// Which way a ball can be pushed near walls.
struct PushingWay {
    Point direction;        ///< length 1
    bool cornered = false;  ///< there is none: in this one there is room behind the ball, but not before it
    Point out;              ///< away from the walls that the ball lies at; zero where it lies at none
};

struct Pusher {
    double behind = 0.35;  ///< m, from the ball's centre back to the robot's reference point
    double room = 0.22;    ///< m, that the robot needs to all sides
    double ballRadius = 0.11;
};

/// `onwards` (length 1), or what is nearest to it in which walls let the ball move and behind which there is room.
PushingWay pushingWay(const Point& ball, const Point& onwards, const std::vector<FloorPlan::Wall>& walls,
                      const Pusher& pusher);

/// `point`, moved to where it is at least `room` from all walls, as they look from the place that they were asked for.
Point clearOf(const std::vector<FloorPlan::Wall>& walls, Point point, double room);

}  // namespace mrose
