#include "behaviour/pushing_way.h"

#include <algorithm>
#include <numbers>

namespace mrose {
namespace {

constexpr double wayStep = std::numbers::pi / 12;  // rad
constexpr int mostWaySteps = 12;                   // to either side
constexpr double atWall = 0.1;                     // m, between a ball and a wall that it lies at
constexpr double leastSlide = 0.5;                 // share of a push that walls must leave

/// What walls leave of a motion.
Point slide(Point motion, const std::vector<FloorPlan::Wall>& walls) {
    for (const FloorPlan::Wall& wall : walls) motion = motion - std::min(0.0, dot(motion, wall.away)) * wall.away;
    return motion;
}

}  // namespace

Point clearOf(const std::vector<FloorPlan::Wall>& walls, Point point, double room) {
    for (const FloorPlan::Wall& wall : walls)
        point = point + std::max(0.0, room - dot(point - wall.nearest, wall.away)) * wall.away;
    return point;
}

PushingWay pushingWay(const Point& ball, const Point& onwards, const std::vector<FloorPlan::Wall>& walls,
                      const Pusher& pusher) {
    PushingWay way{onwards, false, {}};
    std::vector<FloorPlan::Wall> touched;
    for (const FloorPlan::Wall& wall : walls) {
        if (wall.distance > pusher.ballRadius + atWall) continue;
        touched.push_back(wall);
        way.out = way.out + wall.away;
    }
    for (int turns = 0; turns <= mostWaySteps; ++turns)
        for (const int side : {1, -1}) {
            const Point direction = Placement({0, 0, side * turns * wayStep}).rotate(onwards);
            const Point start = ball - pusher.behind * direction;
            if (clearOf(walls, start, pusher.room) != start) continue;
            if (length(slide(direction, touched)) > leastSlide) return {direction, false, way.out};
            if (!way.cornered) way = {direction, true, way.out};
        }
    return way;
}

}  // namespace mrose
