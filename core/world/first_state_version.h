#pragma once

#include <cstddef>
#include <span>

#include "world/state_fields.h"
#include "world/state_hash.h"

namespace mrose {

// States as they were stored until their version 2: what a motion model and the sensors remembered were fields of each
// robot. Recordings and state files of that time can still be read.

/// Those fields.
struct FirstVersionMemory {
    Velocity unperturbed;
    bool hasUnperturbed = false;
    Pose bias, self;
    Nanoseconds selfMeasured = 0;
    bool localised = false;
    double bearingBias = 0;
};

/// Calls leaf(number) for every number of a robot in the order of then: what its sensors remember comes last.
template <class Robot, class Memory, class Leaf>
void visitFirstVersionWorld(Robot& robot, Memory& memory, Leaf&& leaf) {
    visitNumbers(robot.pose, leaf);
    visitNumbers(robot.velocity_B, leaf);
    leaf(robot.nextControl);
    visitNumbers(robot.segment, leaf);
    visitNumbers(memory.unperturbed, leaf);
    leaf(memory.hasUnperturbed);
    leaf(robot.pushed);
    leaf(robot.commandCount);
    visitNumbers(robot.commandBefore, leaf);
    visitNumbers(robot.ready, leaf);
}
template <class Memory, class Leaf>
void visitFirstVersionSensing(Memory& memory, Leaf&& leaf) {
    visitNumbers(memory.bias, leaf);
    visitNumbers(memory.self, leaf);
    leaf(memory.selfMeasured);
    leaf(memory.localised);
    leaf(memory.bearingBias);
}
constexpr std::size_t firstVersionSize = packedSize<RobotState>() + 8 * (2 + 3 + 3 + 1 + 1 - 1) + 2;

/// The blocks that such a robot has now: of every motion model, whether it remembers anything or not, and of the
/// sensors that every robot had. The robots are those of `state` in their order.
constexpr std::size_t firstVersionMotion = 32, firstVersionSelf = 64, firstVersionSight = 16;
void appendMemory(const FirstVersionMemory& memory, WorldState& state);

/// The hash that a state had then; `memories`: of its robots.
StateHash firstVersionHash(const WorldState& state, std::span<const FirstVersionMemory> memories);

}  // namespace mrose
