#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "condition/condition.h"
#include "io/error.h"
#include "simulation/rewind_check.h"
#include "simulation/run_statistics.h"

namespace mrose {

enum class RunEnd { duration, condition, fault, rewind, stopped, noBranch };
const char* name(RunEnd end);

struct RunOptions {
    Nanoseconds duration = 60 * nanosecondsPerSecond;
    Condition* until = nullptr;          ///< the run ends after the first tick at which it holds
    const DrawnValues* drawn = nullptr;  ///< of a trial of an experiment: what questions may ask, too
    /// Asked beside `until`; true ends the run likewise. May be empty.
    std::function<Expected<bool>(const Moment&)> watch = {};
    bool watchFollows = false;  ///< `watch` reads what robots saw and decided
    std::int64_t every = 1;     ///< ticks from one question of `until` and `watch` to the next
    /// Told the run's end, of whatever kind. May be empty.
    std::function<Expected<void>(const Moment&)> finally = {};
    bool endOnFault = false;
    bool checkRewind = false;      ///< takes every tick twice; the run ends where that makes a difference
    bool traceUnread = false;      ///< StepTrace::asksUnread; for a condition that reads sensors so it is without
    bool countsUnfamiliar = true;  ///< RunStatistics::unfamiliar, which costs some 7 % of a run
    bool countsBeyond = false;     ///< RunStatistics::beyond, up to 5 %
    /// Asked after every tick; false stops the run. May be empty.
    std::function<bool(const WorldState&)> goesOn = {};
    /// The same with the tick's trace, which then holds what StepTrace::asksInsights asks for.
    std::function<bool(const WorldState&, const StepTrace&)> each = {};
};

struct RunResult {
    RunEnd end = RunEnd::duration;
    WorldState state;  ///< at its end
    RunStatistics statistics;
    std::vector<RewindDifference> hidden;  ///< what ended it, of RunEnd::rewind
};

/// Runs a scenario from a state. Error: the condition cannot be answered, or that of `watch` or `finally`.
Expected<RunResult> run(const Scenario& scenario, const WorldState& state, const RunOptions& options);

}  // namespace mrose
