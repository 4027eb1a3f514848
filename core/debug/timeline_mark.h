#pragma once

#include <cstdint>

namespace mrose {

/// Something that happened in a tick, as the timeline marks it.
struct TimelineMark {
    enum class Kind : std::uint8_t { contact, kick, goal, fault, stop, hit, divergence };
    std::int64_t tick = 0;  ///< of the state after it
    Kind kind = Kind::contact;
    /// Of a contact: noBody for what stands still; of a goal `other` is its index, of a hit `body` the breakpoint's
    /// number.
    std::uint32_t body = 0, other = 0;
    bool operator==(const TimelineMark&) const = default;
};

}  // namespace mrose
