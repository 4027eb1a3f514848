#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

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

/// The name of an entry, in up to three parts, which are put together only where they are wanted. The parts must
/// outlive it.
class EntryName {
public:
    template <class... Parts>
    requires(sizeof...(Parts) >= 1 && sizeof...(Parts) <= 3 && (std::convertible_to<Parts, std::string_view> && ...))
        EntryName(const Parts&... parts)
        : parts_{std::string_view(parts)...} {}

    bool is(std::string_view name) const {
        for (const std::string_view part : parts_) {
            if (!name.starts_with(part)) return false;
            name.remove_prefix(part.size());
        }
        return name.empty();
    }
    std::string text() const {
        std::string text;
        for (const std::string_view part : parts_) text += part;
        return text;
    }

private:
    std::array<std::string_view, 3> parts_;
};

/// What a memory says: all of it, or the one entry that is asked for, so that a condition may read it at every tick.
class MemoryEntries {
public:
    MemoryEntries() = default;
    explicit MemoryEntries(std::string_view wanted) : wanted_(wanted) {}

    /// Whether an entry is taken: to leave out what would cost something.
    bool wants(const EntryName& name) const { return !wanted_ || (entries_.empty() && name.is(*wanted_)); }
    /// Whether nothing more is wanted.
    bool complete() const { return wanted_ && !entries_.empty(); }

    void add(const EntryName& name, double value, std::string_view unit = {}) {
        if (wants(name)) entries_.push_back({name.text(), value, std::string(unit), {}});
    }
    void add(const EntryName& name, std::string_view text) {
        if (wants(name)) entries_.push_back({name.text(), 0, {}, std::string(text)});
    }
    void add(const MemoryEntry& entry) {
        if (wants(entry.name)) entries_.push_back(entry);
    }

    const std::vector<MemoryEntry>& all() const& { return entries_; }
    std::vector<MemoryEntry> all() && { return std::move(entries_); }

private:
    std::optional<std::string_view> wanted_;
    std::vector<MemoryEntry> entries_;
};

/// All that a part (a controller, a sensor, a model) says of its memory.
template <class Part>
std::vector<MemoryEntry> explained(const Part& part, std::span<const std::byte> memory) {
    MemoryEntries entries;
    part.explain(memory, entries);
    return std::move(entries).all();
}

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
