#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "debug/branch_tree.h"
#include "debug/value_series.h"
#include "io/progress.h"

namespace mrose {

/// Computes what a ValueSeries lacks, beside the run: it goes along copies of stretches of the run's timeline, so that
/// another thread may go on with the run meanwhile.
class SeriesWalk {
public:
    SeriesWalk();
    ~SeriesWalk();

    /// Of a branch, what is needed to go along it.
    struct Stretch {
        BranchSetupPointer setup;
        std::int64_t first = 0;            ///< the earliest tick that can still be reached
        std::optional<Cursor> cursor;      ///< where it begins; nullopt where it was not asked for
        std::optional<Timeline> timeline;  ///< from there on; nullopt: that tick cannot be reached
        std::vector<BranchRecord::InsightAtStart> insightsAtStart = {};
    };
    /// What is asked of the run for a task: a stretch of the task's branch. `run` counts openings, as Task::run does.
    struct Wish {
        std::uint64_t run = 0;
        std::uint32_t branch = 0;
        std::int64_t from = 0;
        bool cursor = true;
    };
    Wish wishFor(const ValueSeries::Task& task);
    /// The answer, in the thread that the run belongs to. nullopt: there is no such branch.
    static std::optional<Stretch> stretchOf(const BranchTree& branches, const Wish& wish);

    struct Asked {
        /// Numbers of the task's ticks from `first` on, as ValueSeries::add() takes them.
        std::function<void(std::int64_t first, const std::vector<std::vector<float>>& columns)> add;
        GoesOn goesOn;  ///< asked before each tick
    };
    /// From the task's first tick to the end of the stretch. nullopt: as far as it goes on; otherwise the task's ticks
    /// up to this one cannot be computed.
    std::optional<std::int64_t> go(const ValueSeries::Task& task, std::optional<Stretch> stretch, const Asked& asked);

private:
    struct Walker;
    Walker& walkerOf(const ValueSeries::Task& task);

    /// For each branch one, and one more for a front.
    std::map<std::pair<std::uint32_t, bool>, std::unique_ptr<Walker>> walkers_;
    std::uint64_t run_ = 0;  ///< in which they walk
};

/// All that is wanted of a run that nobody else goes on with.
void computeAll(ValueSeries& series, const BranchTree& branches);

}  // namespace mrose
