#include "debug/series_walk.h"

#include <algorithm>
#include <chrono>
#include <limits>

namespace mrose {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto addedAfter = std::chrono::milliseconds(20);
/// So much of a timeline is fetched at once.
constexpr std::size_t mostBytesAtOnce = std::size_t{1} << 20;

/// A copy of a timeline's blocks from the one with `tick` on.
Timeline copyFrom(const Timeline& whole, std::int64_t tick) {
    const TimelineBlock& first = whole.blockOf(tick);
    Timeline stretch(first);
    for (const TimelineBlock& block : whole.blocks())
        if (block.first > first.first && stretch.size() < mostBytesAtOnce) stretch.append(block);
    return stretch;
}

}  // namespace

/// Goes along a branch, with what it needs of the run.
struct SeriesWalk::Walker {
    BranchSetupPointer setup;
    std::optional<BranchRecord> record;  ///< its own, to go on with
    std::optional<Cursor> cursor;
    std::optional<Timeline> timeline;  ///< a stretch of the branch's
    std::map<ValueKey, PlottedValue> values;

    bool arrives(const ValueSeries::Task& task, Stretch stretch);
    void prepare(const std::vector<ValueKey>& keys);
    void read(const ValueSeries::Task& task, std::vector<std::vector<float>>& columns) const;
};

SeriesWalk::SeriesWalk() = default;
SeriesWalk::~SeriesWalk() = default;

SeriesWalk::Walker& SeriesWalk::walkerOf(const ValueSeries::Task& task) {
    if (std::exchange(run_, task.run) != task.run) walkers_.clear();
    std::unique_ptr<Walker>& walker = walkers_[{task.branch, task.front}];
    if (!walker) walker = std::make_unique<Walker>();
    return *walker;
}

SeriesWalk::Wish SeriesWalk::wishFor(const ValueSeries::Task& task) {
    const std::optional<Cursor>& cursor = walkerOf(task).cursor;
    const bool stands = cursor && task.tick - cursor->tick() <= 1 && task.tick >= cursor->tick();
    return {task.run, task.branch, stands ? cursor->tick() : task.tick, !stands};
}

std::optional<SeriesWalk::Stretch> SeriesWalk::stretchOf(const BranchTree& branches, const Wish& wish) {
    if (wish.branch >= branches.size()) return {};
    const Timeline& timeline = branches[wish.branch].timeline;
    const BranchRecord& record = branches.record(wish.branch);
    Stretch stretch{record.setupPointer(), timeline.first(), {}, {}, {}};
    if (wish.from < timeline.first() || wish.from > timeline.last()) return stretch;
    stretch.timeline = copyFrom(timeline, wish.from);
    stretch.insightsAtStart = record.insightsAtStart();
    if (wish.cursor)
        if (auto cursor = branches.cursorAt(wish.branch, wish.from)) stretch.cursor = std::move(*cursor);
    return stretch;
}

/// To the task's tick. False: it cannot be reached.
bool SeriesWalk::Walker::arrives(const ValueSeries::Task& task, Stretch stretch) {
    if (setup != stretch.setup) {
        setup = stretch.setup;
        record.emplace(setup, setup->scenario->initialState(), std::vector<HandOrder>{});
        values.clear();
    }
    if (stretch.cursor) cursor = std::move(stretch.cursor);
    timeline = std::move(stretch.timeline);
    record->setInsightsAtStart(std::move(stretch.insightsAtStart));
    return cursor && (cursor->tick() == task.tick || cursor->advance(*record, *timeline));
}

void SeriesWalk::Walker::prepare(const std::vector<ValueKey>& keys) {
    std::erase_if(values,
                  [&](const auto& one) { return std::find(keys.begin(), keys.end(), one.first) == keys.end(); });
    for (const ValueKey& key : keys)
        if (values.count(key) == 0) values.emplace(key, plottedValue(*setup->scenario, key).value_or(PlottedValue{}));
}

void SeriesWalk::Walker::read(const ValueSeries::Task& task, std::vector<std::vector<float>>& columns) const {
    const Moment moment = cursor->moment(*setup->scenario, task.reality.get());
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const PlottedValue& value = values.at(task.values[i]);
        columns[i].push_back(value.read ? static_cast<float>(value.read(moment))
                                        : std::numeric_limits<float>::quiet_NaN());
    }
}

std::optional<std::int64_t> SeriesWalk::go(const ValueSeries::Task& task, std::optional<Stretch> stretch,
                                           const Asked& asked) {
    Walker& walker = walkerOf(task);
    if (!stretch) return task.last;
    if (!stretch->timeline) {
        walker.cursor.reset();
        return std::clamp(stretch->first - 1, task.tick, task.last);  // its beginning has been forgotten
    }
    if (!walker.arrives(task, std::move(*stretch))) return task.last;
    walker.prepare(task.values);
    std::vector<std::vector<float>> columns(task.values.size());
    std::int64_t first = task.tick;
    auto added = Clock::now();
    const std::int64_t end = std::min(task.last, walker.timeline->last());
    while (true) {
        walker.read(task, columns);
        const std::int64_t reached = walker.cursor->tick();
        const bool goesOn = reached < end && asked.goesOn();
        if (!goesOn || Clock::now() - added >= addedAfter) {
            asked.add(first, columns);
            if (!goesOn) return {};
            first = reached + 1;
            for (std::vector<float>& column : columns) column.clear();
            added = Clock::now();
        }
        if (walker.cursor->advance(*walker.record, *walker.timeline)) continue;
        asked.add(first, columns);
        return task.last;  // the timeline is damaged
    }
}

void computeAll(ValueSeries& series, const BranchTree& branches) {
    SeriesWalk walk;
    while (const auto task = series.nextTask()) {
        const auto add = [&](std::int64_t first, const std::vector<std::vector<float>>& columns) {
            series.add(*task, first, columns);
        };
        auto stretch = SeriesWalk::stretchOf(branches, walk.wishFor(*task));
        if (const auto unknown = walk.go(*task, std::move(stretch), {add, [] { return true; }}))
            series.giveUp(*task, *unknown);
    }
}

}  // namespace mrose
