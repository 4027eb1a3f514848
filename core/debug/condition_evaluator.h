#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "condition/condition.h"
#include "debug/branch_setup.h"
#include "debug/breakpoint.h"
#include "debug/tick_ranges.h"
#include "recording/timeline.h"

namespace mrose {

/// What a condition gave at those ticks at which it was asked.
struct Verdicts {
    TickRanges asked, holds, failed;  ///< `failed`: it could not be answered, and so does not hold

    void add(std::int64_t tick, const Expected<bool>& answer);
    void add(const Verdicts& others);
};

/// Some ticks of a block of a timeline, in which conditions are to be asked. The state with which the block begins is
/// only asked of where it is the timeline's first: elsewhere it is the end of the block before, which knows the step
/// that led there.
struct BlockTicks {
    const BranchSetup* setup = nullptr;
    const TimelineBlock* block = nullptr;
    std::int64_t first = 0, last = 0;
};

/// Asks conditions over blocks that have been, on all cores. It steps again by the recorded decisions and asks no
/// controller: the world comes out as it was, to the last bit; of the rest conditions must ask nothing (readsControl).
class ConditionEvaluator {
public:
    ConditionEvaluator();
    ~ConditionEvaluator();

    /// For each block the verdicts on each of `texts`. What does not compile for the block's branch holds nowhere in
    /// it. Error: a block is damaged.
    Expected<std::vector<std::vector<Verdicts>>> evaluate(std::span<const BlockTicks> blocks,
                                                          std::span<const std::string> texts,
                                                          const RealityPointer& reality);

private:
    struct Worker;
    std::unique_ptr<Worker> takeWorker();

    std::mutex mutex_;
    std::vector<std::unique_ptr<Worker>> idle_;
};

}  // namespace mrose
