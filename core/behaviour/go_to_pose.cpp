#include "behaviour/go_to_pose.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "behaviour/back_off.h"
#include "behaviour/own_belief.h"
#include "behaviour/steering.h"

namespace mrose {
namespace {

struct Going {
    enum Phase : std::int64_t { approaching, aligning, resting, backingOff };
    static constexpr std::array names{"approaching", "aligning", "resting", "backing off"};
};

constexpr double alignGain = 2;           // 1/s
constexpr double turnAwayFromGoal = 0.6;  // rad, after backing off
constexpr double unsure = 4;              // standard deviations of its belief, before it leaves where it has arrived

}  // namespace

struct GoToPose::Memory {
    MotionMemory motion;
    OwnBelief self;
    BackOff backOff;
    std::int64_t target;
    std::int64_t phase;
    std::int64_t tailFirst;
};

std::size_t GoToPose::memorySize() const {
    static_assert(sizeof(Memory) == sizeof(MotionMemory) + sizeof(OwnBelief) + sizeof(BackOff) + 3 * 8, "no padding");
    return sizeof(Memory);
}

const Pose& GoToPose::target(const Memory& memory) const {
    return options_.targets[static_cast<std::size_t>(memory.target)];
}

/// By where the robot will be when what it is told now takes effect.
void GoToPose::updatePhase(Memory& memory, const Pose& ahead) const {
    const Point line = position(target(memory)) - position(ahead);
    const double off = length(line), turn = std::abs(wrapAngle(target(memory).heading - ahead.heading));
    const Placement frame(ahead);
    const double onwards = frame.rotateBack(line).x * (memory.tailFirst != 0 ? -1 : 1);
    if (memory.phase == Going::backingOff) memory.phase = Going::approaching;
    if (memory.phase != Going::approaching &&
        off > options_.tolerance + unsure * std::sqrt(memory.self.positionVariance))
        memory.phase = Going::approaching;
    if (memory.phase == Going::approaching &&
        (off < options_.tolerance / 2 || (off < options_.tolerance && onwards < 0)))
        memory.phase = Going::aligning;
    if (memory.phase == Going::aligning && turn < options_.headingTolerance / 2) memory.phase = Going::resting;
    if (memory.phase == Going::resting &&
        turn > options_.headingTolerance + unsure * std::sqrt(memory.self.headingVariance))
        memory.phase = Going::aligning;
    // Once it goes tail first, it stays so until the target is clearly ahead, and the other way round.
    if (memory.phase == Going::approaching && options_.backwards && onwards < -0.2 * off) memory.tailFirst ^= 1;
}

Command GoToPose::drive(const Observation& observation, Memory& memory) const {
    const DriveLimits limits{options_.speed, options_.rotation};
    if (const std::optional<Command> back = memory.backOff.update(
            observation, memory.motion, {options_.speed, options_.rotation, options_.deadTime, turnAwayFromGoal})) {
        memory.phase = Going::backingOff;
        return *back;
    }
    const Pose ahead = memory.self.pose * memory.motion.motionDuring(options_.deadTime);
    updatePhase(memory, ahead);
    if (memory.phase == Going::resting) {
        const bool standing = std::abs(observation.velocity.v) < 0.05 && std::abs(observation.velocity.w) < 0.1;
        const auto count = static_cast<std::int64_t>(options_.targets.size());
        if (standing && (options_.loop || memory.target + 1 < count)) {
            memory.target = (memory.target + 1) % count;
            memory.phase = Going::approaching;
        }
        return {};
    }
    if (memory.phase == Going::aligning) {
        const double turn = wrapAngle(target(memory).heading - ahead.heading);
        return {0, std::clamp(alignGain * turn, -options_.rotation, options_.rotation)};
    }
    const double reach = std::min(1.5, distance(position(ahead), position(target(memory))));
    const Command intended = driveToPose(ahead, target(memory), limits, memory.tailFirst != 0);
    return evading(intended, evade(observation.robots, memory.motion, options_.deadTime, reach), limits);
}

void GoToPose::annotate(const Memory& memory, Decision& decision) const {
    const Point goal = position(target(memory));
    decision.annotations.push_back({.kind = Annotation::Kind::point, .label = "goal", .points = {goal}});
    decision.annotations.push_back({.label = "distance", .value = distance(position(memory.self.pose), goal)});
    decision.annotations.push_back({.kind = Annotation::Kind::text,
                                    .label = "state",
                                    .text = Going::names[static_cast<std::size_t>(memory.phase)]});
}

void GoToPose::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    memory.motion.observe(observation);
    memory.self.update(observation, memory.motion);
    decision.command = Command{};
    if (memory.self.known != 0 && !options_.targets.empty()) {
        decision.command = drive(observation, memory);
        annotate(memory, decision);
    }
    memory.motion.issue(*decision.command);
}

}  // namespace mrose
