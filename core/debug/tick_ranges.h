#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace mrose {

/// Ticks in a row.
struct TickRange {
    std::int64_t first = 0, last = 0;  ///< both among them
    bool operator==(const TickRange&) const = default;
};

/// Ticks in a row of a branch.
struct BranchTicks {
    std::uint32_t branch = 0;
    std::int64_t first = 0, last = 0;  ///< both among them
    bool operator==(const BranchTicks&) const = default;
};

/// A set of ticks, kept as the ranges that it consists of.
class TickRanges {
public:
    void add(std::int64_t first, std::int64_t last);
    void add(std::int64_t tick) { add(tick, tick); }
    bool empty() const { return ranges_.empty(); }
    bool contains(std::int64_t tick) const { return rangeOf(tick) != nullptr; }
    /// The range that a tick lies in; nullptr: in none.
    const TickRange* rangeOf(std::int64_t tick) const;
    /// The last of its ticks up to `tick`, the first from it on; nullopt: there is none.
    std::optional<std::int64_t> lastUpTo(std::int64_t tick) const;
    std::optional<std::int64_t> firstFrom(std::int64_t tick) const;
    /// Ascending; two of them have a tick between them that is in none.
    const std::vector<TickRange>& ranges() const { return ranges_; }
    /// How many ranges begin from one tick to another, both among them.
    std::int64_t beginningsWithin(std::int64_t first, std::int64_t last) const;

private:
    std::vector<TickRange> ranges_;
};

}  // namespace mrose
