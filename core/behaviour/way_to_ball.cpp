#include "behaviour/way_to_ball.h"

#include <algorithm>
#include <cmath>

#include "behaviour/rolling_ball.h"

namespace mrose {
namespace {

constexpr double longestRoll = 20;  // s: by then it lies
constexpr double mostBlocked = 2;

double blockedBy(std::span<const Point> bodies, const Point& from, const Point& sight, double far) {
    double sum = 0;
    for (const Point& body : bodies) {
        const Point off = body - from;
        const double along = dot(off, sight), across = std::abs(cross(sight, off));
        if (along > 0 && along < far) sum += std::max(0.0, WayToBall::lane - across);
    }
    return std::min(sum, mostBlocked);
}

/// Where the ball comes to rest, if at no wall before.
Point restOf(const WayToBall::Situation& situation) {
    const double speed = length(situation.rolls);
    if (speed == 0) return situation.ball;
    const Point far = RollingBall{situation.ball, situation.rolls}.after(longestRoll, {}).position;
    const Point way = (1 / speed) * situation.rolls;
    double roll = distance(situation.ball, far);
    if (situation.walls != nullptr) roll = situation.walls->freeWay(situation.ball, way, situation.ballRadius, roll);
    return situation.ball + roll * way;
}

}  // namespace

WayToBall::WayToBall(const Situation& situation) {
    const Point here = position(situation.robot);
    const Point line = situation.ball - here;
    distance = length(line);
    const Point sight = distance > 1e-9 ? (1 / distance) * line : situation.onwards;
    // Seen along the line of sight: where the push goes to.
    const double turn = direction({dot(sight, situation.onwards), cross(sight, situation.onwards)});
    const double side = turn < 0 ? -1 : 1;
    round = std::abs(turn);
    const Point ball_B = Placement(situation.robot).rotateBack(sight);
    bearing = side * direction(ball_B);
    bearingCosine = ball_B.x;
    speed = situation.velocity.v;
    turning = side * situation.velocity.w;
    rollsAway = dot(situation.rolls, sight);
    rollsAside = side * cross(sight, situation.rolls);
    rest = mrose::distance(here, restOf(situation));
    if (situation.walls != nullptr)
        for (const FloorPlan::Wall& wall : situation.walls->wallsNear(situation.ball, farRoom))
            room = std::min(room, wall.distance);
    cornered = situation.cornered ? 1 : 0;
    blocked = blockedBy(situation.bodies, here, sight, distance);
    const Point behind = situation.ball - situation.behind * situation.onwards;
    for (const Point& body : situation.bodies) {
        crowded += std::max(0.0, lane - mrose::distance(body, behind));
        other = std::min(other, mrose::distance(body, situation.ball));
    }
    crowded = std::min(crowded, mostBlocked);
    stuck = std::min(situation.stuck, longStuck);
}

}  // namespace mrose
