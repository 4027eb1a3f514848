#include <algorithm>
#include <cmath>

#include "geometry/point.h"
#include "simulation/step_stages.h"

namespace mrose {
namespace {

Point velocityAt(const RobotState& robot, const Placement& frame, const Point& point_B) {
    const Twist& v = robot.velocity_B;
    return frame.rotate({v.x - v.rotation * point_B.y, v.y + v.rotation * point_B.x});
}

/// Whether a ball's edge lies before the manipulator's face.
bool reaches(const Manipulator& manipulator, const Point& ball_B, double radius) {
    const Point direction = towards(manipulator.direction);
    const Point offset = ball_B - manipulator.position;
    const double ahead = dot(offset, direction) - radius;
    // A ball that has been pressed into the face a little is before it too.
    return std::abs(cross(direction, offset)) <= manipulator.width / 2 && ahead <= manipulator.reach &&
           ahead >= -radius / 2;
}

void act(const Scenario& scenario, WorldState& state, const PendingKick& kick, StepTrace* trace) {
    const Manipulator& manipulator = scenario.scene().typeOf(kick.robot).manipulators[kick.manipulator];
    RobotState& robot = state.robots[kick.robot];
    if (robot.ready[kick.manipulator] > kick.due) return;
    robot.ready[kick.manipulator] = kick.due + manipulator.recharge;
    const Placement frame(robot.pose);
    const Point direction = frame.rotate(towards(manipulator.direction));
    StepTrace::Kicked kicked{kick.robot, kick.manipulator};
    for (std::uint32_t i = 0; i < state.objects.size() && !kicked.hit; ++i) {
        const ObjectType& type = scenario.scene().typeOfObject(i);
        ObjectState& object = state.objects[i];
        if (!type.rolls || !reaches(manipulator, frame.placeBack(position(object.pose)), type.shape->reach)) continue;
        const Point velocity{object.velocity_W.x, object.velocity_W.y};
        const double wanted =
            dot(velocityAt(robot, frame, manipulator.position), direction) + kick.power * manipulator.speed;
        const Point after = velocity + std::max(0.0, wanted - dot(velocity, direction)) * direction;
        object.velocity_W.x = after.x;
        object.velocity_W.y = after.y;
        kicked.hit = true;
        kicked.object = i;
        kicked.speed_W = after;
    }
    if (trace != nullptr) trace->kicks.push_back(kicked);
}

}  // namespace

void kick(const Scenario& scenario, WorldState& state, StepTrace* trace) {
    if (state.kicks.empty()) return;
    const Nanoseconds end = scenario.scene().timeOf(state.tick + 1);
    for (const PendingKick& kick : state.kicks)
        if (kick.due < end) act(scenario, state, kick, trace);
    std::erase_if(state.kicks, [&](const PendingKick& kick) { return kick.due < end; });
}

}  // namespace mrose
