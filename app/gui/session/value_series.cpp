#include "session/value_series.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <utility>

#include "io/caught.h"
#include "session/awaited.h"

namespace mrose::gui {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto deliveredAfter = std::chrono::milliseconds(20);
/// So much of a timeline is fetched at once.
constexpr std::size_t mostBytesAtOnce = std::size_t{1} << 20;
constexpr float noNumber = std::numeric_limits<float>::quiet_NaN();

/// A copy of a timeline's blocks from the one with `tick` on.
Timeline stretchOf(const Timeline& whole, std::int64_t tick) {
    const TimelineBlock& first = whole.blockOf(tick);
    Timeline stretch(first);
    for (const TimelineBlock& block : whole.blocks())
        if (block.first > first.first && stretch.size() < mostBytesAtOnce) stretch.append(block);
    return stretch;
}

}  // namespace

/// Goes along a branch, with what it needs of the run.
struct ValueSeries::Walker {
    BranchSetupPointer setup;
    std::optional<BranchRecord> record;  ///< this thread's own, to go on with
    std::optional<Cursor> cursor;
    std::optional<Timeline> timeline;  ///< a stretch of the branch's
    std::map<ValueKey, PlottedValue> values;
};

ValueSeries::ValueSeries(Session& session) : session_(session), worker_([this] { work(); }) {}

ValueSeries::~ValueSeries() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
    }
    wake_.notify_all();
    worker_.join();
}

void ValueSeries::want(std::vector<ValueKey> values) {
    {
        const std::lock_guard lock(mutex_);
        values_ = std::move(values);
        std::erase_if(series_, [&](const auto& one) {
            return std::find(values_.begin(), values_.end(), one.first.second) == values_.end();
        });
        ++version_;
    }
    wake_.notify_all();
}

void ValueSeries::follow(std::uint64_t run, std::shared_ptr<const Reality> reality, std::vector<Way> ways) {
    {
        const std::lock_guard lock(mutex_);
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
    wake_.notify_all();
}

void ValueSeries::cancel() {
    const std::lock_guard lock(mutex_);
    ++version_;
    for (const Way& way : ways_)
        for (const ValueKey& key : values_) {
            TickNumbers& numbers = series_.try_emplace({way.branch, key}, TickNumbers{way.first, {}}).first->second;
            if (numbers.end() <= way.last)
                numbers.values.resize(static_cast<std::size_t>(way.last + 1 - numbers.first), noNumber);
        }
    settled_.notify_all();
}

void ValueSeries::settle() {
    std::unique_lock lock(mutex_);
    settled_.wait(lock, [this] { return behindNow() == 0; });
}

void ValueSeries::read(std::uint32_t branch, const ValueKey& key,
                       const std::function<void(const TickNumbers&)>& read) const {
    const std::lock_guard lock(mutex_);
    const auto found = series_.find({branch, key});
    if (found != series_.end()) read(found->second);
}

std::int64_t ValueSeries::behind() const {
    const std::lock_guard lock(mutex_);
    return behindNow();
}

/// Of each branch as many as its value that is farthest behind.
std::int64_t ValueSeries::behindNow() const {
    std::int64_t behind = 0;
    for (const Way& way : ways_) {
        std::int64_t most = 0;
        for (const ValueKey& key : values_) {
            const auto found = series_.find({way.branch, key});
            most = std::max(most, way.last + 1 - (found == series_.end() ? way.first : found->second.end()));
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
            const auto found = series_.find({way.branch, key});
            ends.push_back(found == series_.end() ? way.first : found->second.end());
        }
        const auto next = nextTicks(way, ends);
        if (!next) continue;
        Task task{run_, way.branch, next->tick, way.last, {}, reality_, next->front};
        for (const std::size_t value : next->values) task.values.push_back(values_[value]);
        return task;
    }
    return {};
}

bool ValueSeries::frontWaits() const {
    const std::lock_guard lock(mutex_);
    const auto next = nextTask();
    return next && next->front;
}

void ValueSeries::work() {
    std::unique_lock lock(mutex_);
    while (!quit_) {
        const std::optional<Task> task = nextTask();
        if (!task) {
            settled_.notify_all();
            wake_.wait(lock);
            continue;
        }
        lock.unlock();
        const auto done = caught([&] { go(*task); });
        if (!done) session_.reportFailure(done.error());
        const bool goesOn = done || caught([&] { giveUp(*task, task->last); });
        lock.lock();
        if (!goesOn) values_.clear();
    }
}

/// What the session's thread gives for a task.
struct ValueSeries::Answer {
    BranchSetupPointer setup;
    std::int64_t first = 0;            ///< the earliest tick that can still be reached
    std::optional<Cursor> cursor;      ///< at the task's tick; nullopt where the walker needs none
    std::optional<Timeline> timeline;  ///< from there on
    std::vector<BranchRecord::InsightAtStart> insightsAtStart = {};
};

std::optional<ValueSeries::Answer> ValueSeries::ask(const Walker& walker, const Task& task) const {
    const bool stands = walker.cursor && task.tick - walker.cursor->tick() <= 1 && task.tick >= walker.cursor->tick();
    const std::int64_t from = stands ? walker.cursor->tick() : task.tick;
    auto promise = std::make_shared<std::promise<std::optional<Answer>>>();
    session_.look([promise, task, stands, from](TimeTravel* travel, std::uint64_t run) {
        std::optional<Answer> answer;
        if (travel != nullptr && run == task.run && task.branch < travel->branches().size()) {
            const Timeline& timeline = travel->branches()[task.branch].timeline;
            answer.emplace(Answer{travel->record(task.branch).setupPointer(), timeline.first()});
            if (from >= timeline.first() && from <= timeline.last()) {
                answer->timeline = stretchOf(timeline, from);
                answer->insightsAtStart = travel->record(task.branch).insightsAtStart();
                if (!stands)
                    if (auto cursor = travel->cursorAt(task.branch, from)) answer->cursor = std::move(*cursor);
            }
        }
        promise->set_value(std::move(answer));
    });
    // Long work of the session may keep it from answering.
    return awaited(promise->get_future(), [this] { return !quit_; }).value_or(std::nullopt);
}

/// Brings a walker to the task's tick, with the stretch of the timeline that goes on from there. False: nothing can be
/// described now.
bool ValueSeries::prepare(Walker& walker, const Task& task) {
    std::optional<Answer> answer = ask(walker, task);
    if (!answer) return giveUp(task, task.last), false;
    if (!answer->timeline) {
        walker.cursor.reset();
        // Its beginning has been forgotten.
        return giveUp(task, std::clamp(answer->first - 1, task.tick, task.last)), false;
    }
    if (walker.setup != answer->setup) {
        walker.setup = answer->setup;
        walker.record.emplace(walker.setup, walker.setup->scenario->initialState(), std::vector<HandOrder>{});
        walker.values.clear();
    }
    if (answer->cursor) walker.cursor = std::move(answer->cursor);
    walker.timeline = std::move(answer->timeline);
    walker.record->setInsightsAtStart(std::move(answer->insightsAtStart));
    const bool arrives = walker.cursor && (walker.cursor->tick() == task.tick ||
                                           walker.cursor->advance(*walker.record, *walker.timeline));
    if (!arrives) giveUp(task, task.last);
    return arrives;
}

/// Some ticks of a branch, for all values at once.
void ValueSeries::go(const Task& task) {
    if (std::exchange(walkersOf_, task.run) != task.run) walkers_.clear();
    std::unique_ptr<Walker>& walker = walkers_[{task.branch, task.front}];
    if (!walker) walker = std::make_unique<Walker>();
    if (!prepare(*walker, task)) return;
    std::erase_if(walker->values, [&](const auto& one) {
        return std::find(task.values.begin(), task.values.end(), one.first) == task.values.end();
    });
    for (const ValueKey& key : task.values)
        if (walker->values.count(key) == 0)
            walker->values.emplace(key, plottedValue(*walker->setup->scenario, key).value_or(PlottedValue{}));
    if (!report(*walker, task)) giveUp(task, task.last);
}

/// From where the walker stands to the end of its stretch. False: the timeline is damaged.
bool ValueSeries::report(Walker& walker, const Task& task) {
    std::vector<std::vector<float>> columns(task.values.size());
    const std::uint64_t version = version_;
    std::int64_t first = task.tick;
    auto delivered = Clock::now();
    const std::int64_t end = std::min(task.last, walker.timeline->last());
    for (bool goesOn = true; goesOn;) {
        const Moment moment = walker.cursor->moment(*walker.setup->scenario, task.reality.get());
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const PlottedValue& value = walker.values.at(task.values[i]);
            columns[i].push_back(value.read ? static_cast<float>(value.read(moment)) : noNumber);
        }
        const std::int64_t reported = walker.cursor->tick();
        goesOn = reported < end && !quit_ && version == version_;
        if (!goesOn || Clock::now() - delivered >= deliveredAfter) {
            append(task, first, columns);
            first = reported + 1;
            for (std::vector<float>& column : columns) column.clear();
            delivered = Clock::now();
            if (!task.front && frontWaits()) return true;
        }
        if (goesOn && !walker.cursor->advance(*walker.record, *walker.timeline))
            return append(task, first, columns), false;
    }
    return true;
}

void ValueSeries::append(const Task& task, std::int64_t first, const std::vector<std::vector<float>>& columns) {
    {
        const std::lock_guard lock(mutex_);
        if (run_ != task.run || reality_ != task.reality) return;
        const auto way =
            std::find_if(ways_.begin(), ways_.end(), [&](const Way& w) { return w.branch == task.branch; });
        if (way == ways_.end()) return;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (std::find(values_.begin(), values_.end(), task.values[i]) == values_.end()) continue;
            TickNumbers& numbers =
                series_.try_emplace({task.branch, task.values[i]}, TickNumbers{way->first, {}}).first->second;
            // What was forgotten of a long run's beginning stays unknown.
            if (numbers.end() < first && first <= way->first)
                numbers.values.resize(static_cast<std::size_t>(first - numbers.first), noNumber);
            const std::int64_t known = numbers.end() - first;
            if (known < 0 || known >= static_cast<std::int64_t>(columns[i].size())) continue;
            numbers.values.insert(numbers.values.end(), columns[i].begin() + known, columns[i].end());
        }
    }
    announce();
}

/// What cannot be reached is unknown, once and for all.
void ValueSeries::giveUp(const Task& task, std::int64_t last) {
    {
        const std::lock_guard lock(mutex_);
        if (run_ != task.run || reality_ != task.reality) return;
        for (const ValueKey& key : task.values) {
            TickNumbers& numbers = series_.try_emplace({task.branch, key}, TickNumbers{task.tick, {}}).first->second;
            if (numbers.end() <= last)
                numbers.values.resize(static_cast<std::size_t>(last + 1 - numbers.first), noNumber);
        }
    }
    announce();
}

void ValueSeries::announce() {
    {
        const std::lock_guard lock(mutex_);
        if (std::exchange(announced_, true)) return;
    }
    QMetaObject::invokeMethod(
        this,
        [this] {
            {
                const std::lock_guard lock(mutex_);
                announced_ = false;
            }
            emit grown();
        },
        Qt::QueuedConnection);
}

}  // namespace mrose::gui
