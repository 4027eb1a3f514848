#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/point.h"
#include "world/command_history.h"
#include "world/memory.h"
#include "world/radio_limits.h"

namespace mrose {

/// The way of a robot through one of its control periods: start * exp(p(s)), s from 0 to 1, p cubic. Its ends match the
/// predicted pose and the velocities at both ends.
struct MotionSegment {
    std::int64_t startTick = 0;
    Pose start;                ///< in the world; moved along with a pushed robot when it has recovered
    Point direction{1, 0};     ///< cosine and sine of its heading
    Pose increment;            ///< what the model predicted: start * increment is the pose at the period's end
    Twist logarithm;           ///< of the increment: p(1)
    Twist startRate, endRate;  ///< p'(0) and p'(1), per period
    Velocity endVelocity;      ///< predicted
};

constexpr std::size_t maxManipulators = 4;

/// One robot, or a person or machine that moves like one. Its commands and what its controller, its sensors and its
/// motion model remember lie in the world state's own arrays: each robot has as much of them as it needs, and none owns
/// heap memory.
struct RobotState {
    Pose pose;
    Twist velocity_B;              ///< m/s, m/s, rad/s: the one that really occurs, of the reference point
    std::int64_t lastControl = 0;  ///< tick at which its controller decided last; what arrived until then it was told
    std::int64_t nextControl = 0;  ///< tick at which it decides next
    MotionSegment segment;
    bool pushed = false;  ///< contact changed its velocity, and its wheels have not restored it yet
    std::uint32_t commandCount = 0;
    Command commandBefore;                             ///< in force before the oldest command kept
    std::array<Nanoseconds, maxManipulators> ready{};  ///< when each manipulator can act again
};

/// A body that no controller moves: the ball, a box.
struct ObjectState {
    Pose pose;
    Twist velocity_W;  ///< of the reference point: m/s, m/s, rad/s about the vertical
    Point roll_W;      ///< m/s: the velocity at which a ball would be rolling, of its spin about horizontal axes
};

/// What a touching pair pressed on in the last tick; warm-starts the next, so that resting bodies rest.
struct ContactImpulse {
    std::uint32_t bodyA = 0, pieceA = 0;  ///< bodies: robots first, then objects, then noBody for what stands still
    std::uint32_t bodyB = 0, pieceB = 0;
    std::uint32_t feature = 0;
    float normal = 0, tangent = 0;  ///< N s
};
constexpr std::uint32_t noBody = 0xffffffff;

/// A kick that has been commanded and is on its way through the dead time.
struct PendingKick {
    Nanoseconds due = 0;
    std::uint32_t robot = 0, manipulator = 0;
    double power = 0;  ///< 0 ... 1
};

/// What one robot told another, or all (noBody), and what is yet to be received.
struct SentMessage {
    std::int64_t tick = 0;     ///< when
    std::uint64_t number = 0;  ///< among those that it sent then
    std::uint32_t from = 0, to = noBody;
    std::uint32_t kind = 0, size = 0;
    Point position;                       ///< m: where the sender was
    Nanoseconds latency = 0, jitter = 0;  ///< of the radio that it was sent by
    std::array<std::byte, mostMessageBytes> bytes{};
};

/// That something touched a robot in a tick. Kept for as long as its sensors ask for it, where they feel touches.
struct RobotTouch {
    std::int64_t tick = 0;  ///< at whose beginning: what happens in a tick is of its end
    std::uint32_t robot = 0, other = noBody;
    Point place_B;  ///< m, in the robot's frame
};

/// Everything that advances in time. A tick is a function of it and of the scenario, which is constant: from a copy one
/// can go back to it, to the last bit.
struct WorldState {
    std::int64_t tick = 0;
    std::uint64_t seed = 0;
    std::vector<RobotState> robots;
    std::vector<ObjectState> objects;      ///< the ball first, where there is one
    std::vector<ContactImpulse> contacts;  ///< of the last tick, in the order of their keys
    std::vector<PendingKick> kicks;        ///< in the order in which they were commanded
    std::vector<SentMessage> messages;     ///< that may be on their way, in the order in which they were sent
    std::vector<std::int32_t> goals;       ///< balls so far in each of the environment's goals
    std::vector<StampedCommand> commands;  ///< of all robots; Scenario::layout says whose are where
    std::vector<std::byte> motion;         ///< memory of all motion models, likewise
    std::vector<std::byte> memory;         ///< of all controllers, likewise
    std::vector<std::byte> sensing;        ///< memory of all sensors, likewise
    std::vector<Pose> past;                ///< of all bodies in the last ticks, for sensors that are late; likewise
    std::vector<RobotTouch> touches;  ///< of the last ticks, in the order of their ticks, for sensors that feel them
};

}  // namespace mrose
