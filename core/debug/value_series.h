#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "assessment/reality.h"
#include "debug/plotted_value.h"
#include "debug/tick_numbers.h"
#include "debug/tick_ranges.h"

namespace mrose {

/// The past of values that are plotted: their numbers at every tick of the branches that are shown, as far as they are
/// known, and what is to be computed next. Who computes it (series_walk.h) adds it here.
class ValueSeries {
public:
    /// The numbers of all others are forgotten.
    void want(std::vector<ValueKey> values);
    /// The branches of the `run`th run that was opened of which they are wanted, the most urgent first, as far as each
    /// is known. Numbers that depend on the real log are forgotten where they came from another one.
    void follow(std::uint64_t run, std::shared_ptr<const Reality> reality, std::vector<BranchTicks> wanted);
    /// Leaves out what has not been computed of the past. What comes is computed as ever.
    void cancel();

    /// nullptr: nothing of it is known yet.
    const TickNumbers* find(std::uint32_t branch, const ValueKey& key) const;
    std::int64_t behind() const;  ///< ticks that are still to be computed
    /// Changes where what is being computed may not be wanted any more.
    std::uint64_t version() const { return version_; }

    /// Some ticks of a branch, for some of the values at once.
    struct Task {
        std::uint64_t run = 0;
        std::uint32_t branch = 0;
        std::int64_t tick = 0, last = 0;
        std::vector<ValueKey> values;
        std::shared_ptr<const Reality> reality;
        bool front = false;  ///< of the values that are known farthest
    };
    /// nullopt: all is known.
    std::optional<Task> nextTask() const;
    /// From a tick on, a column for each of the task's values.
    void add(const Task& task, std::int64_t first, const std::vector<std::vector<float>>& columns);
    /// What cannot be reached, up to a tick, is unknown once and for all.
    void giveUp(const Task& task, std::int64_t last);

private:
    std::uint64_t run_ = 0;
    std::vector<BranchTicks> wanted_;  ///< the most urgent first
    std::vector<ValueKey> values_;
    std::shared_ptr<const Reality> reality_;
    std::map<std::pair<std::uint32_t, ValueKey>, TickNumbers> series_;
    std::uint64_t version_ = 0;
};

/// What of a branch is to be computed next.
struct NextTicks {
    std::int64_t tick = 0;  ///< the first
    bool front = false;     ///< of the values that are known farthest: the newest go before another one's past
    std::vector<std::size_t> values;
};
/// `ends`: for each value the tick after the last that is known. nullopt: all are known.
std::optional<NextTicks> nextTicks(const BranchTicks& wanted, const std::vector<std::int64_t>& ends);

}  // namespace mrose
