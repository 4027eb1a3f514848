#include "behaviour/wander.h"

#include <algorithm>

#include "behaviour/back_off.h"
#include "behaviour/dice.h"
#include "behaviour/memory_entries.h"
#include "behaviour/own_belief.h"
#include "behaviour/steering.h"

namespace mrose {
namespace {

constexpr double smoothing = 0.5;   // s, to take another curve
constexpr double strollAway = 1.5;  // rad
constexpr double spareRoom = 0.05;  // m, to walls
constexpr double sideways = 1;      // rad, to either side: where it looks for a way on
constexpr double leastLook = 0.3;   // m, ahead, and the more the wider its curves are

}  // namespace

struct Wander::Memory {
    MotionMemory motion;
    OwnBelief self;
    BackOff backOff;
    Nanoseconds change;     ///< when it takes another curve
    double curve, turning;  ///< rad/s: wanted, and commanded
    double side;            ///< 1 or -1, where it turns before a wall; 0: there is none ahead
};

std::size_t Wander::memorySize() const {
    static_assert(sizeof(Memory) == sizeof(MotionMemory) + sizeof(OwnBelief) + sizeof(BackOff) + 4 * 8, "no padding");
    return sizeof(Memory);
}

/// Turns to the freer side where a wall is ahead, on the spot if it is near.
Command Wander::alongWalls(const Command& intended, Memory& memory) const {
    if (memory.self.known == 0) return intended;
    const Pose ahead = memory.self.pose * memory.motion.motionDuring(options_.deadTime);
    const double look = leastLook + 2 * options_.speed / std::max(0.05, options_.rotation);
    const auto way = [&](double turn) {
        const Point direction = Placement({0, 0, ahead.heading + turn}).rotate({1, 0});
        return options_.walls->freeWay(position(ahead), direction, options_.radius + spareRoom, look);
    };
    const double free = way(0);
    if (free >= look) {
        memory.side = 0;
        return intended;
    }
    if (memory.side == 0) {
        const double left = way(sideways), right = way(-sideways);
        memory.side = (left == right ? intended.w >= 0 : left > right) ? 1 : -1;
    }
    memory.turning = memory.side * options_.rotation;
    return {intended.v * std::min(1.0, 2 * free / look), memory.turning};
}

Command Wander::stroll(const Observation& observation, Memory& memory) const {
    if (observation.time >= memory.change) {
        Dice dice(observation.noise);
        memory.curve = dice.between(-0.5, 0.5) * options_.rotation;
        memory.change = observation.time + fromSeconds(dice.between(0.5, 1.5) * options_.changeEvery);
    }
    const double share = std::min(1.0, toSeconds(memory.motion.sinceLast()) / smoothing);
    memory.turning += share * (memory.curve - memory.turning);
    Evasion evasion = evade(observation.robots(), memory.motion, options_.deadTime);
    const Evasion objects = evade(observation.objects(), memory.motion, options_.deadTime);
    if (objects.share < evasion.share || evasion.turn == 0) evasion = objects;
    return evading(alongWalls({options_.speed, memory.turning}, memory), evasion, {options_.speed, options_.rotation});
}

void Wander::explain(std::span<const std::byte> bytes, MemoryEntries& entries) const {
    const Memory& memory = as<Memory>(bytes);
    const Nanoseconds now = memory.motion.now();
    entries.add("curve wanted", memory.curve, "rad/s");
    entries.add("curve told", memory.turning, "rad/s");
    entries.add("another curve in", toSeconds(std::max<Nanoseconds>(0, memory.change - now)), "s");
    entries.add("turns before a wall", memory.side == 0 ? "no wall ahead" : memory.side < 0 ? "right" : "left");
    explainSelf(memory.self, now, entries);
    explainBackOff(memory.backOff, now, entries);
}

void Wander::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    memory.motion.observe(observation);
    memory.self.update(observation, memory.motion);
    const std::optional<Command> back = memory.backOff.update(
        observation, memory.motion, {options_.speed, options_.rotation, options_.deadTime, strollAway});
    decision.command = back ? *back : stroll(observation, memory);
    memory.motion.issue(*decision.command);
    if (!decision.wantsAnnotations) return;
    decision.annotations.push_back(
        {.kind = Annotation::Kind::text, .label = "state", .text = back ? "backing off" : "strolling"});
}

}  // namespace mrose
