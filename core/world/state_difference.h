#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "world/world_state.h"

namespace mrose {

/// Where two states differ. Bits count: 0 and -0 differ, a nan equals itself.
struct StateDifference {
    enum class Part {
        state,
        robot,
        object,
        contact,
        kick,
        message,
        goal,
        command,
        motion,
        memory,
        sensing,
        past,
        touch
    };
    Part part = Part::state;
    std::size_t index = 0;  ///< of the robot, object ..., from 0; of the byte in WorldState::motion, memory or sensing
    std::string field;      ///< "pose.x"; "robots" where their numbers differ; may be empty
    std::string first, second;  ///< the values, as text

    bool ofBytes() const;     ///< of an array of memory, whose bytes have no names
    bool ofMemories() const;  ///< of what StateHash::memories covers
    /// "robot 2 pose.x: 1.25 against 1.2500001", counted from 1.
    std::string message() const;
};

/// What is compared: what StateHash::world covers, or all.
enum class StateScope { world, all };

/// The first difference in the order of WorldState's members; nullopt: they are the same to the last bit.
std::optional<StateDifference> firstDifference(const WorldState& a, const WorldState& b,
                                               StateScope scope = StateScope::all);

}  // namespace mrose
