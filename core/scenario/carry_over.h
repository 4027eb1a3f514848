#pragma once

#include <cstdint>
#include <span>

#include "scenario/scenario.h"

namespace mrose {

/// The same instant in another scenario: one whose robots have other motion models or controllers, or whose
/// descriptions were changed and loaded again. Bodies are matched by their names; those that are new stand as at `to`'s
/// start. Poses, velocities, seed, commands as far back as `to`'s models read, kicks and messages on their way,
/// contacts and what sensors remember stay. A controller or an object's model keeps its memory where it is of the same
/// class and size, a robot's motion model where it is the same (sameMotion()); otherwise they start. Until its next
/// control instant a robot stays on its way; one whose control period differs decides at once. Where nothing differs,
/// the state is the same to the last bit.
WorldState carriedOver(const Scenario& from, const WorldState& state, const Scenario& to);

/// Copies the newest commands into slots, as many as there is room for, and gives what was in force before; how many.
std::uint32_t keepNewest(std::span<const StampedCommand> commands, std::span<StampedCommand> slots, Command& before);

}  // namespace mrose
