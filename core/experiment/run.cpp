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
        case RunEnd::noBranch:
            return "no branch";
        case RunEnd::duration:
            break;
    }
    return "duration";
}

namespace {

/// A run under way.
class Running {
public:
    Running(const Scenario& scenario, const WorldState& state, const RunOptions& options)
        : scenario_(scenario),
          options_(options),
          // Only who asks for them pays for them.
          follows_(options.watchFollows ||
                   (options.until != nullptr && readsInsights(options.until->text(), scenario))),
          first_(state.tick),
          insights_(follows_ ? state.robots.size() : 0),
          result_{RunEnd::duration,
                  state,
                  RunStatistics(scenario, state, options.countsUnfamiliar, options.countsBeyond),
                  {}} {
        trace_.asksUnread = follows_ || options.traceUnread;
        trace_.asksInsights = follows_ || options.each || options.checkRewind;
    }

    Expected<RunResult> go() {
        const Nanoseconds tick = scenario_.scene().tickLength;
        const std::int64_t last = first_ + (options_.duration + tick - 1) / tick;
        while (result_.state.tick < last) {
            const auto end = takeTick();
            if (!end) return tl::unexpected(end.error());
            if (!*end) continue;
            result_.end = **end;
            break;
        }
        if (options_.finally)
            if (const auto told = options_.finally(now()); !told) return tl::unexpected(told.error());
        return std::move(result_);
    }

private:
    /// How the run ended with this tick; nullopt: it goes on.
    Expected<std::optional<RunEnd>> takeTick() {
        if (follows_) before_ = result_.state.memory;
        if (options_.checkRewind)
            result_.hidden = stepTwice(scenario_, result_.state, buffers_, trace_);
        else
            step(scenario_, result_.state, buffers_, {}, &trace_);
        result_.statistics.add(result_.state, trace_);
        if (follows_) noteInsights(scenario_, trace_, result_.state.tick, before_, insights_);
        if (options_.each && !options_.each(result_.state, trace_)) return RunEnd::stopped;
        if (options_.goesOn && !options_.goesOn(result_.state)) return RunEnd::stopped;
        if (!result_.hidden.empty()) return RunEnd::rewind;
        if (options_.endOnFault && !trace_.faults.empty()) return RunEnd::fault;
        if ((result_.state.tick - first_) % options_.every != 0) return std::nullopt;
        for (const bool watched : {false, true}) {
            if (watched ? !options_.watch : options_.until == nullptr) continue;
            const auto over = watched ? options_.watch(now()) : options_.until->holds(now());
            if (!over) return tl::unexpected(over.error());
            if (*over) return RunEnd::condition;
        }
        return std::nullopt;
    }
    Moment now() const { return {&scenario_, &result_.state, &trace_, insights_, nullptr, options_.drawn}; }

    const Scenario& scenario_;
    const RunOptions& options_;
    bool follows_;
    std::int64_t first_;
    std::vector<RobotInsight> insights_;
    RunResult result_;
    StepBuffers buffers_;
    StepTrace trace_;
    decltype(WorldState::memory) before_;  ///< of the controllers, before the tick
};

}  // namespace

Expected<RunResult> run(const Scenario& scenario, const WorldState& state, const RunOptions& options) {
    return Running(scenario, state, options).go();
}

}  // namespace mrose
