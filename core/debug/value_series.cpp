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

void ValueSeries::follow(std::uint64_t run, std::shared_ptr<const Reality> reality, std::vector<Way> ways) {
    if (reality != reality_) {
        std::erase_if(series_, [](const auto& one) { return readsReality(one.first.second); });
        reality_ = std::move(reality);
        ++version_;
    }
    if (std::exchange(run_, run) != run) {
        series_.clear();
        ++version_;
    }
    ways_ = std::move(ways);
}

void ValueSeries::cancel() {
    ++version_;
    for (const Way& way : ways_)
        for (const ValueKey& key : values_)
            fillUpTo(series_.try_emplace({way.branch, key}, TickNumbers{way.first, {}}).first->second, way.last);
}

const TickNumbers* ValueSeries::find(std::uint32_t branch, const ValueKey& key) const {
    const auto found = series_.find({branch, key});
    return found == series_.end() ? nullptr : &found->second;
}

/// Of each branch as many as its value that is farthest behind.
std::int64_t ValueSeries::behind() const {
    std::int64_t behind = 0;
    for (const Way& way : ways_) {
        std::int64_t most = 0;
        for (const ValueKey& key : values_) {
            const TickNumbers* const known = find(way.branch, key);
            most = std::max(most, way.last + 1 - (known == nullptr ? way.first : known->end()));
        }
        behind += most;
    }
    return behind;
}

std::optional<NextTicks> nextTicks(const ValueSeries::Way& way, const std::vector<std::int64_t>& ends) {
    const auto [least, most] = std::minmax_element(ends.begin(), ends.end());
    if (ends.empty() || *least > way.last) return {};
    NextTicks next;
    next.front = *most <= way.last && *most > std::max(*least, way.first);
    next.tick = std::max(way.first, next.front ? *most : *least);
    for (std::size_t i = 0; i < ends.size(); ++i)
        if (next.front ? ends[i] == *most : ends[i] <= way.last) next.values.push_back(i);
    return next;
}

std::optional<ValueSeries::Task> ValueSeries::nextTask() const {
    for (const Way& way : ways_) {
        std::vector<std::int64_t> ends;
        for (const ValueKey& key : values_) {
            const TickNumbers* const known = find(way.branch, key);
            ends.push_back(known == nullptr ? way.first : known->end());
        }
        const auto next = nextTicks(way, ends);
        if (!next) continue;
        Task task{run_, way.branch, next->tick, way.last, {}, reality_, next->front};
        for (const std::size_t value : next->values) task.values.push_back(values_[value]);
        return task;
    }
    return {};
}

void ValueSeries::add(const Task& task, std::int64_t first, const std::vector<std::vector<float>>& columns) {
    if (run_ != task.run || reality_ != task.reality) return;
    const auto way = std::find_if(ways_.begin(), ways_.end(), [&](const Way& w) { return w.branch == task.branch; });
    if (way == ways_.end()) return;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (std::find(values_.begin(), values_.end(), task.values[i]) == values_.end()) continue;
        TickNumbers& numbers =
            series_.try_emplace({task.branch, task.values[i]}, TickNumbers{way->first, {}}).first->second;
        // What was forgotten of a long run's beginning stays unknown.
        if (first <= way->first) fillUpTo(numbers, first - 1);
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
