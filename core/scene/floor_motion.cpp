#include "scene/floor_motion.h"

#include <algorithm>
#include <cmath>

#include "scene/scene.h"

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

/// A flat body slides and turns about its centre of mass until friction has stopped both.
ObjectState slideOn(const ObjectState& state, const Shape& shape, double deceleration, double duration) {
    ObjectState after = state;
    double rotation = state.velocity_W.rotation;
    const Point centre = Placement(state.pose).rotate(shape.centroid);
    Point velocity{state.velocity_W.x - rotation * centre.y, state.velocity_W.y + rotation * centre.x};
    const Point way = slowDown(velocity, deceleration, duration);
    // Friction acts at two thirds of its reach.
    const double turning = deceleration * (2.0 / 3.0) * shape.reach / std::max(1e-6, shape.gyration * shape.gyration);
    after.pose.heading += slowDownTurn(rotation, turning, duration);
    const Point centreAfter = Placement(after.pose).rotate(shape.centroid);
    move(after.pose, way + centre - centreAfter);
    after.velocity_W = {velocity.x + rotation * centreAfter.y, velocity.y - rotation * centreAfter.x, rotation};
    return after;
}

bool atRest(const ObjectState& object) { return object.velocity_W == Twist{} && object.roll_W == Point{}; }

}  // namespace

ObjectState afterFloorMotion(const ObjectState& state, const ObjectType& type, const FloorSurface& floor,
                             double frictionFactor, double duration) {
    const double sliding = floor.slidingFriction * frictionFactor * gravity;
    const double rolling = floor.rollingDeceleration * frictionFactor;
    if (!type.rolls) return slideOn(state, *type.shape, sliding, duration);
    ObjectState after = state;
    Point velocity{state.velocity_W.x, state.velocity_W.y};
    double left = duration;
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
    // About the vertical: by the torque that slows its rolling.
    const double turning = rolling / (type.inertia * type.shape->reach);
    after.pose.heading += slowDownTurn(after.velocity_W.rotation, turning, duration);
    after.velocity_W.x = velocity.x;
    after.velocity_W.y = velocity.y;
    return after;
}

ObjectState FloorMotion::after(const ObjectInput& input) const {
    if (atRest(input.state)) return input.state;
    const double factor = input.randomFactor == 0 ? 1 : 1 + input.randomFactor * (2 * uniformNoise(input.noise) - 1);
    return afterFloorMotion(input.state, input.type, input.floor, factor, input.duration);
}

std::shared_ptr<const ObjectModel> floorMotion() {
    static const std::shared_ptr<const ObjectModel> model = std::make_shared<const FloorMotion>();
    return model;
}

}  // namespace mrose
