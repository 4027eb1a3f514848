#include "debug/value_series.h"

#include <algorithm>
#include <limits>

namespace mrose {
namespace {

constexpr float noNumber = std::numeric_limits<float>::quiet_NaN();

void fillUpTo(TickNumbers& numbers, std::int64_t last) {
    if (numbers.end() <= last) numbers.values.resize(static_cast<std::size_t>(last + 1 - numbers.first), noNumber);
}

}  // namespace

void ValueSeries::want(std::vector<ValueKey> values) {
    values_ = std::move(values);
    std::erase_if(series_, [&](const auto& one) {
        return std::find(values_.begin(), values_.end(), one.first.second) == values_.end();
    });
    ++version_;
}

void ValueSeries::follow(std::uint64_t run, std::shared_ptr<const Reality> reality, std::vector<BranchTicks> wanted) {
    if (reality != reality_) {
        std::erase_if(series_, [](const auto& one) { return readsReality(one.first.second); });
        reality_ = std::move(reality);
        ++version_;
    }
    if (std::exchange(run_, run) != run) {
        series_.clear();
        ++version_;
    }
    wanted_ = std::move(wanted);
}

void ValueSeries::cancel() {
    ++version_;
    for (const BranchTicks& wanted : wanted_)
        for (const ValueKey& key : values_)
            fillUpTo(series_.try_emplace({wanted.branch, key}, TickNumbers{wanted.first, {}}).first->second,
                     wanted.last);
}

const TickNumbers* ValueSeries::find(std::uint32_t branch, const ValueKey& key) const {
    const auto found = series_.find({branch, key});
    return found == series_.end() ? nullptr : &found->second;
}

/// Of each branch as many as its value that is farthest behind.
std::int64_t ValueSeries::behind() const {
    std::int64_t behind = 0;
    for (const BranchTicks& wanted : wanted_) {
        std::int64_t most = 0;
        for (const ValueKey& key : values_) {
            const TickNumbers* const known = find(wanted.branch, key);
            most = std::max(most, wanted.last + 1 - (known == nullptr ? wanted.first : known->end()));
        }
        behind += most;
    }
    return behind;
}

std::optional<NextTicks> nextTicks(const BranchTicks& wanted, const std::vector<std::int64_t>& ends) {
    const auto [least, most] = std::minmax_element(ends.begin(), ends.end());
    if (ends.empty() || *least > wanted.last) return {};
    NextTicks next;
    next.front = *most <= wanted.last && *most > std::max(*least, wanted.first);
    next.tick = std::max(wanted.first, next.front ? *most : *least);
    for (std::size_t i = 0; i < ends.size(); ++i)
        if (next.front ? ends[i] == *most : ends[i] <= wanted.last) next.values.push_back(i);
    return next;
}

std::optional<ValueSeries::Task> ValueSeries::nextTask() const {
    for (const BranchTicks& wanted : wanted_) {
        std::vector<std::int64_t> ends;
        for (const ValueKey& key : values_) {
            const TickNumbers* const known = find(wanted.branch, key);
            ends.push_back(known == nullptr ? wanted.first : known->end());
        }
        const auto next = nextTicks(wanted, ends);
        if (!next) continue;
        Task task{run_, wanted.branch, next->tick, wanted.last, {}, reality_, next->front};
        for (const std::size_t value : next->values) task.values.push_back(values_[value]);
        return task;
    }
    return {};
}

void ValueSeries::add(const Task& task, std::int64_t first, const std::vector<std::vector<float>>& columns) {
    if (run_ != task.run || reality_ != task.reality) return;
    const auto wanted =
        std::find_if(wanted_.begin(), wanted_.end(), [&](const BranchTicks& w) { return w.branch == task.branch; });
    if (wanted == wanted_.end()) return;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (std::find(values_.begin(), values_.end(), task.values[i]) == values_.end()) continue;
        TickNumbers& numbers =
            series_.try_emplace({task.branch, task.values[i]}, TickNumbers{wanted->first, {}}).first->second;
        // What was forgotten of a long run's beginning stays unknown.
        if (first <= wanted->first) fillUpTo(numbers, first - 1);
        const std::int64_t known = numbers.end() - first;
        if (known < 0 || known >= static_cast<std::int64_t>(columns[i].size())) continue;
        numbers.values.insert(numbers.values.end(), columns[i].begin() + known, columns[i].end());
    }
}

void ValueSeries::giveUp(const Task& task, std::int64_t last) {
    if (run_ != task.run || reality_ != task.reality) return;
    for (const ValueKey& key : task.values)
        fillUpTo(series_.try_emplace({task.branch, key}, TickNumbers{task.tick, {}}).first->second, last);
}

}  // namespace mrose
