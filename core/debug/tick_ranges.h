#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace mrose {

/// A set of ticks, kept as the ranges that it consists of.
class TickRanges {
public:
    struct Range {
        std::int64_t first = 0, last = 0;  ///< both among them
        bool operator==(const Range&) const = default;
    };

    void add(std::int64_t first, std::int64_t last);
    void add(std::int64_t tick) { add(tick, tick); }
    bool empty() const { return ranges_.empty(); }
    bool contains(std::int64_t tick) const { return rangeOf(tick) != nullptr; }
    /// The range that a tick lies in; nullptr: in none.
    const Range* rangeOf(std::int64_t tick) const;
    /// The last of its ticks up to `tick`, the first from it on; nullopt: there is none.
    std::optional<std::int64_t> lastUpTo(std::int64_t tick) const;
    std::optional<std::int64_t> firstFrom(std::int64_t tick) const;
    /// Ascending; two of them have a tick between them that is in none.
    const std::vector<Range>& ranges() const { return ranges_; }
    /// How many ranges begin from one tick to another, both among them.
    std::int64_t beginningsWithin(std::int64_t first, std::int64_t last) const;

private:
    std::vector<Range> ranges_;
};

}  // namespace mrose
