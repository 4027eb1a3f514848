#include "experiment/run.h"

namespace mrose {

const char* name(RunEnd end) {
    switch (end) {
        case RunEnd::condition:
            return "condition";
        case RunEnd::fault:
            return "fault";
        case RunEnd::rewind:
            return "rewind";
        case RunEnd::stopped:
            return "stopped";
        case RunEnd::duration:
            break;
    }
    return "duration";
}

Expected<RunResult> run(const Scenario& scenario, WorldState state, const RunOptions& options) {
    RunResult result{RunEnd::duration, std::move(state), RunStatistics(scenario)};
    const Nanoseconds tick = scenario.scene().tickLength;
    const std::int64_t last = result.state.tick + (options.duration + tick - 1) / tick;
    StepBuffers buffers;
    StepTrace trace;
    WorldState before = result.state;
    // Only who asks for them pays for them.
    const bool follows = options.until != nullptr && readsControl(options.until->text(), scenario);
    trace.asksUnread = follows || options.traceUnread;
    std::vector<RobotInsight> insights(follows ? result.state.robots.size() : 0);
    while (result.state.tick < last) {
        before = result.state;
        if (options.checkRewind)
            result.hidden = stepTwice(scenario, result.state, buffers, trace);
        else
            step(scenario, result.state, buffers, {}, &trace);
        result.statistics.add(before, result.state, trace);
        if (options.each && !options.each(result.state, trace)) {
            result.end = RunEnd::stopped;
            return result;
        }
        if (!result.hidden.empty()) {
            result.end = RunEnd::rewind;
            return result;
        }
        if (options.endOnFault && !trace.faults.empty()) {
            result.end = RunEnd::fault;
            return result;
        }
        if (options.until == nullptr) continue;
        if (follows) noteInsights(scenario, trace, result.state.tick, before.memory, insights);
        const auto holds = options.until->holds({&scenario, &result.state, &trace, insights});
        if (!holds) return tl::unexpected(holds.error());
        if (*holds) {
            result.end = RunEnd::condition;
            return result;
        }
    }
    return result;
}

}  // namespace mrose
