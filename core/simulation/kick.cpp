#include <algorithm>
#include <cmath>

#include "geometry/point.h"
#include "manipulation/learned_kicker.h"
#include "simulation/step_stages.h"
#include "world/noise_channel.h"

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

NoiseKey kickKey(const WorldState& state, std::uint32_t robot, std::uint32_t manipulator) {
    return {state.seed, state.tick, robot, channelOf(NoiseChannel::kick, manipulator)};
}

Velocity drivenVelocity(const RobotState& robot) { return {robot.velocity_B.x, robot.velocity_B.rotation}; }

/// What a kick does to a ball: it leaves in this direction, at least so fast along it.
struct Push {
    bool hit = false;
    Point direction_W;
    double speed = 0;  ///< m/s
};

/// By the parameters of its robot file.
Push pushOf(const Manipulator& manipulator, const PendingKick& kick, const RobotState& robot, const Placement& frame,
            const Point& ball_B, double radius) {
    const Point direction = frame.rotate(towards(manipulator.direction));
    return {reaches(manipulator, ball_B, radius), direction,
            dot(velocityAt(robot, frame, manipulator.position), direction) + kick.power * manipulator.speed};
}

/// As it was learned; the draw is the same whichever ball it is for.
Push learnedPush(const LearnedKicker& kicker, const PendingKick& kick, const RobotState& robot, const Placement& frame,
                 const Point& ball_B, const NoiseKey& key) {
    if (!kicker.inReach(ball_B)) return {};
    const KickDeparture drawn = kicker.drawDeparture({kick.power, drivenVelocity(robot), ball_B}, key);
    return {drawn.hit, frame.rotate(towards(drawn.direction)), drawn.speed};
}

void act(const Scenario& scenario, WorldState& state, const PendingKick& kick, StepTrace* trace) {
    const Manipulator& manipulator = scenario.scene().typeOf(kick.robot).manipulators[kick.manipulator];
    RobotState& robot = state.robots[kick.robot];
    if (robot.ready[kick.manipulator] > kick.due) return;
    robot.ready[kick.manipulator] = kick.due + manipulator.recharge;
    const Placement frame(robot.pose);
    StepTrace::Kicked kicked{kick.robot, kick.manipulator, kick.due};
    for (std::uint32_t i = 0; i < state.objects.size() && !kicked.hit; ++i) {
        const ObjectType& type = scenario.scene().typeOfObject(i);
        ObjectState& object = state.objects[i];
        if (!type.rolls) continue;
        const Point ball_B = frame.placeBack(position(object.pose));
        const Push push = manipulator.learned ? learnedPush(*manipulator.learned, kick, robot, frame, ball_B,
                                                            kickKey(state, kick.robot, kick.manipulator))
                                              : pushOf(manipulator, kick, robot, frame, ball_B, type.shape->reach);
        if (!push.hit) continue;
        const Point velocity{object.velocity_W.x, object.velocity_W.y};
        const Point after = velocity + std::max(0.0, push.speed - dot(velocity, push.direction_W)) * push.direction_W;
        object.velocity_W.x = after.x;
        object.velocity_W.y = after.y;
        kicked.hit = true;
        kicked.object = i;
        kicked.speed_W = after;
    }
    if (trace != nullptr) trace->kicks.push_back(kicked);
}

}  // namespace

Nanoseconds kickDue(const Scene& scene, const WorldState& state, std::uint32_t robot, const Kick& kick) {
    const Manipulator& manipulator = scene.typeOf(robot).manipulators[kick.manipulator];
    const Nanoseconds now = scene.timeOf(state.tick);
    if (!manipulator.learned) return now + manipulator.deadTime;
    const KickState commanded{kick.power, drivenVelocity(state.robots[robot]), {}};
    return now + manipulator.learned->drawDelay(commanded, kickKey(state, robot, kick.manipulator));
}

void kick(const Scenario& scenario, WorldState& state, StepTrace* trace) {
    if (state.kicks.empty()) return;
    const Nanoseconds end = scenario.scene().timeOf(state.tick + 1);
    for (const PendingKick& kick : state.kicks)
        if (kick.due < end) act(scenario, state, kick, trace);
    std::erase_if(state.kicks, [&](const PendingKick& kick) { return kick.due < end; });
}

}  // namespace mrose
