#include "behaviour/wander.h"

#include <algorithm>

#include "behaviour/back_off.h"
#include "behaviour/dice.h"
#include "behaviour/steering.h"

namespace mrose {
namespace {

constexpr double smoothing = 0.5;   // s, to take another curve
constexpr double strollAway = 1.5;  // rad

}  // namespace

struct Wander::Memory {
    MotionMemory motion;
    BackOff backOff;
    Nanoseconds change;     ///< when it takes another curve
    double curve, turning;  ///< rad/s: wanted, and told
};

std::size_t Wander::memorySize() const {
    static_assert(sizeof(Memory) == sizeof(MotionMemory) + sizeof(BackOff) + 3 * 8, "no padding");
    return sizeof(Memory);
}

Command Wander::stroll(const Observation& observation, Memory& memory) const {
    if (observation.time >= memory.change) {
        Dice dice(observation.noise);
        memory.curve = dice.between(-0.5, 0.5) * options_.rotation;
        memory.change = observation.time + fromSeconds(dice.between(0.5, 1.5) * options_.changeEvery);
    }
    const double share = std::min(1.0, toSeconds(memory.motion.sinceLast()) / smoothing);
    memory.turning += share * (memory.curve - memory.turning);
    Evasion evasion = evade(observation.robots, memory.motion, options_.deadTime);
    const Evasion objects = evade(observation.objects, memory.motion, options_.deadTime);
    if (objects.share < evasion.share || evasion.turn == 0) evasion = objects;
    return evading({options_.speed, memory.turning}, evasion, {options_.speed, options_.rotation});
}

void Wander::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    memory.motion.observe(observation);
    const std::optional<Command> back = memory.backOff.update(
        observation, memory.motion, {options_.speed, options_.rotation, options_.deadTime, strollAway});
    decision.command = back ? *back : stroll(observation, memory);
    memory.motion.issue(*decision.command);
    decision.annotations.push_back(
        {.kind = Annotation::Kind::text, .label = "state", .text = back ? "backing off" : "strolling"});
}

}  // namespace mrose
