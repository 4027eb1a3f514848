#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <type_traits>

namespace mrose {

// Whatever lives in simulated time (a controller, a sensor, a motion model) is const, and what it remembers is a block
// of bytes in the world's state: going back is exact, and one object serves many robots.

/// How much of an array of the state a block takes: each begins at a multiple of 16 bytes.
constexpr std::size_t paddedMemory(std::size_t bytes) { return (bytes + 15) / 16 * 16; }

/// An entry of a memory, as a person reads it.
struct MemoryEntry {
    std::string name;  ///< no other entry of the memory has it
    double value = 0;
    std::string unit = {};  ///< "m", "rad", "s" ...; "" of what is counted or has a text
    std::string text = {};  ///< instead of the value, where there is one
};

/// A memory as a type: trivially copyable, without padding worth hashing.
template <class Memory>
Memory& as(std::span<std::byte> memory) {
    static_assert(std::is_trivially_copyable_v<Memory>);
    return *reinterpret_cast<Memory*>(memory.data());
}

template <class Memory>
const Memory& as(std::span<const std::byte> memory) {
    static_assert(std::is_trivially_copyable_v<Memory>);
    return *reinterpret_cast<const Memory*>(memory.data());
}

}  // namespace mrose
