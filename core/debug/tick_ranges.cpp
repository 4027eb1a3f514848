#include "debug/tick_ranges.h"

#include <algorithm>
#include <cassert>

namespace mrose {
namespace {

bool endsBefore(const TickRange& range, std::int64_t tick) { return range.last < tick; }

bool beginsBefore(const TickRange& range, std::int64_t tick) { return range.first < tick; }

}  // namespace

void TickRanges::add(std::int64_t first, std::int64_t last) {
    assert(first <= last);
    // All that overlap or touch it become one.
    const auto begin = std::lower_bound(ranges_.begin(), ranges_.end(), first - 1, endsBefore);
    const auto end = std::lower_bound(begin, ranges_.end(), last + 2, beginsBefore);
    if (begin == end) {
        ranges_.insert(begin, {first, last});
        return;
    }
    *begin = {std::min(first, begin->first), std::max(last, (end - 1)->last)};
    ranges_.erase(begin + 1, end);
}

const TickRange* TickRanges::rangeOf(std::int64_t tick) const {
    const auto found = std::lower_bound(ranges_.begin(), ranges_.end(), tick, endsBefore);
    return found != ranges_.end() && found->first <= tick ? &*found : nullptr;
}

std::optional<std::int64_t> TickRanges::lastUpTo(std::int64_t tick) const {
    const auto after = std::lower_bound(ranges_.begin(), ranges_.end(), tick + 1, beginsBefore);
    if (after == ranges_.begin()) return {};
    return std::min(tick, (after - 1)->last);
}

std::optional<std::int64_t> TickRanges::firstFrom(std::int64_t tick) const {
    const auto found = std::lower_bound(ranges_.begin(), ranges_.end(), tick, endsBefore);
    if (found == ranges_.end()) return {};
    return std::max(tick, found->first);
}

std::int64_t TickRanges::beginningsWithin(std::int64_t first, std::int64_t last) const {
    const auto begin = std::lower_bound(ranges_.begin(), ranges_.end(), first, beginsBefore);
    return std::max<std::int64_t>(0, std::lower_bound(begin, ranges_.end(), last + 1, beginsBefore) - begin);
}

}  // namespace mrose
