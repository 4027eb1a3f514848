#include "simulation/floor_motion.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

void move(Pose& pose, const Point& by) {
    pose.x += by.x;
    pose.y += by.y;
}

/// Slows `velocity` down by `deceleration`, at most to rest; the way meanwhile.
Point slowDown(Point& velocity, double deceleration, double duration) {
    const double speed = length(velocity);
    if (speed == 0) return {};
    const Point direction = (1 / speed) * velocity;
    if (deceleration <= 0) return duration * velocity;
    const double t = std::min(duration, speed / deceleration);
    velocity = t < duration ? Point{} : (speed - deceleration * t) * direction;
    return (speed * t - deceleration * t * t / 2) * direction;
}

double slowDownTurn(double& rotation, double deceleration, double duration) {
    Point turning{rotation, 0};
    const double turned = slowDown(turning, deceleration, duration).x;
    rotation = turning.x;
    return turned;
}

}  // namespace

ObjectState afterFloorMotion(const ObjectState& state, const ObjectType& type, const FloorSurface& floor,
                             double frictionFactor, double duration) {
    ObjectState after = state;
    Point velocity{state.velocity_W.x, state.velocity_W.y};
    const double sliding = floor.slidingFriction * frictionFactor * gravity;
    const double rolling = floor.rollingDeceleration * frictionFactor;
    const double reach = type.shape->reach;
    double left = duration;
    if (type.rolls) {
        const Point slip = velocity - state.roll_W;
        const double slipSpeed = length(slip);
        // Friction slows the slip by its own deceleration and by what it adds to the spin.
        const double slipDeceleration = sliding * (1 + 1 / type.inertia);
        if (slipSpeed > 0 && slipDeceleration > 0) {
            const double t = std::min(left, slipSpeed / slipDeceleration);
            const Point direction = (1 / slipSpeed) * slip;
            move(after.pose, t * velocity - (sliding * t * t / 2) * direction);
            velocity = velocity - (sliding * t) * direction;
            after.roll_W = t < left ? velocity : state.roll_W + (sliding / type.inertia * t) * direction;
            left -= t;
        }
        if (left > 0 && (slipSpeed == 0 || slipDeceleration > 0)) {
            move(after.pose, slowDown(velocity, rolling, left));
            after.roll_W = velocity;
        } else if (left > 0) {
            move(after.pose, left * velocity);
        }
    } else {
        move(after.pose, slowDown(velocity, sliding, left));
    }
    // About the vertical: a ball by the torque that slows its rolling, a flat body by friction at 2/3 of its reach.
    const double gyration = type.shape->gyration;
    const double turning = type.rolls ? rolling / (type.inertia * reach)
                                      : sliding * (2.0 / 3.0) * reach / std::max(1e-6, gyration * gyration);
    after.pose.heading += slowDownTurn(after.velocity_W.rotation, turning, duration);
    after.velocity_W.x = velocity.x;
    after.velocity_W.y = velocity.y;
    return after;
}

}  // namespace mrose
