#include "behaviour/rolling_ball.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

constexpr double rollingDeceleration = 0.4;  // m/s2
constexpr double metByBall = 0.002;          // m, from a wall: as near as a free way ends
constexpr int mostWalls = 4;                 // that it meets in one go; then it lies
constexpr double justOff = 1 + 1e-9;

/// Without what leads into walls that it touches.
Point alongWalls(const RollingBall& ball, const BallFloor& floor) {
    Point way = ball.velocity;
    for (const FloorPlan::Wall& wall : floor.walls->wallsNear(ball.position, floor.ballRadius + metByBall))
        if (const double closing = -dot(way, wall.away); closing > 0) way = way + justOff * closing * wall.away;
    return way;
}

}  // namespace

RollingBall RollingBall::after(double seconds, const BallFloor& floor) const {
    RollingBall ball = *this;
    for (int met = 0; met <= mostWalls; ++met) {
        const double speed = length(ball.velocity);
        if (speed == 0) return ball;
        const double duration = std::min(seconds, speed / rollingDeceleration);
        const double way = duration * (speed - rollingDeceleration * duration / 2);
        const Point direction = (1 / speed) * ball.velocity;
        const double free =
            floor.walls == nullptr ? way : floor.walls->freeWay(ball.position, direction, floor.ballRadius, way);
        if (free >= way) {
            ball.position = ball.position + way * direction;
            ball.velocity = (1 - rollingDeceleration * duration / speed) * ball.velocity;
            return ball;
        }
        const double left = std::sqrt(speed * speed - 2 * rollingDeceleration * free);
        seconds -= (speed - left) / rollingDeceleration;
        ball.position = ball.position + free * direction;
        ball.velocity = left * direction;
        ball.velocity = alongWalls(ball, floor);
    }
    ball.velocity = {};
    return ball;
}

}  // namespace mrose
