#pragma once

#include <cstdint>

#include "world/world_state.h"

namespace mrose {

/// Two fingerprints of a state (XXH3, 64 bits each). Equal states have equal ones; states that differ in any bit of any
/// field, also in the sign of a zero, almost surely do not.
struct StateHash {
    std::uint64_t world = 0;     ///< tick, seed, bodies and their motion, commands, contacts, kicks, messages, goals
    std::uint64_t memories = 0;  ///< what sensors and controllers remember, and past poses
    bool operator==(const StateHash&) const = default;
};

StateHash hashOf(const WorldState& state);

}  // namespace mrose
