#include "experiment/trial_run.h"

#include <algorithm>

namespace mrose {

std::unique_ptr<Workplace> Workplaces::take() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return std::make_unique<Workplace>(experiment_, loading_);
    auto place = std::move(free_.back());
    free_.pop_back();
    return place;
}

void Workplaces::giveBack(std::unique_ptr<Workplace> place) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(place));
}

std::int64_t ticksBetweenLooks(const Experiment& experiment, const Scene& scene) {
    return std::max<std::int64_t>(1, experiment.every / scene.tickLength);
}

TrialMeasurement measurementOf(const Experiment& experiment, CompiledExpressions& compiled, const Scenario& scenario) {
    return {experiment, compiled, ticksBetweenLooks(experiment, scenario.scene()) * scenario.scene().tickLength};
}

RunOptions measuring(TrialMeasurement& measurement, const CompiledExpressions& compiled, const Experiment& experiment,
                     const Scenario& scenario, const DrawnValues& drawn) {
    RunOptions options;
    options.duration = scenario.parts().duration;
    options.endOnFault = true;
    options.watchFollows = compiled.follows;
    options.every = ticksBetweenLooks(experiment, scenario.scene());
    options.drawn = &drawn;
    options.watch = [&measurement](const Moment& at) { return measurement.look(at); };
    options.finally = [&measurement](const Moment& at) { return measurement.end(at); };
    return options;
}

void endByFault(RunResult& result, const Error& error) {
    result.end = RunEnd::fault;
    if (result.statistics.faults++ == 0) result.statistics.firstFault = error.message();
}

std::vector<MeasuredValue> measuredValues(const Experiment& experiment, const TrialMeasurement& measurement) {
    std::vector<MeasuredValue> values;
    for (std::size_t i = 0; i < experiment.features.size(); ++i)
        values.push_back({"feature." + experiment.features[i].name, measurement.features()[i]});
    for (std::size_t i = 0; i < experiment.measures.size(); ++i)
        values.push_back({"measure." + experiment.measures[i].name, measurement.measures()[i]});
    return values;
}

namespace {

/// From a start; `asked` is the moment at which features are asked.
Expected<MeasuredRun> measuredFrom(const Experiment& experiment, const CompiledExpressions& compiled,
                                   TrialMeasurement measurement, const Moment& asked, const Scenario& scenario,
                                   const WorldState& start, const GoesOn& goesOn, bool countsUnfamiliar) {
    RunOptions options = measuring(measurement, compiled, experiment, scenario, *asked.drawn);
    options.countsUnfamiliar = countsUnfamiliar;
    options.goesOn = [&](const WorldState&) { return !goesOn || goesOn(); };
    std::optional<Error> failed;
    options.watch = [&](const Moment& at) -> Expected<bool> {
        const auto over = measurement.look(at);
        if (!over) failed = over.error();
        return !over || *over;
    };
    options.finally = [&](const Moment& at) -> Expected<void> {
        if (failed) return {};
        if (const auto ended = measurement.end(at); !ended) failed = ended.error();
        return {};
    };
    if (const auto begun = measurement.begin(asked); !begun) {
        failed = begun.error();
        options.duration = 0;
    }
    auto result = run(scenario, start, options);
    if (!result) return tl::unexpected(result.error());
    if (failed && result->end != RunEnd::stopped) {
        measurement.skip();
        endByFault(*result, *failed);
    }
    return MeasuredRun{std::move(*result), std::move(measurement)};
}

}  // namespace

Expected<MeasuredRun> measuredRun(const Experiment& experiment, TrialExpressions& expressions, const Scenario& scenario,
                                  const DrawnValues& drawn, std::uint64_t seed, const GoesOn& goesOn,
                                  bool countsUnfamiliar) {
    WorldState start = scenario.initialState(seed);
    const std::vector<RobotInsight> none(start.robots.size());
    const Moment atStart{.scenario = &scenario, .state = &start, .insights = none, .drawn = &drawn};
    const auto compiled = expressions.of(atStart);
    if (!compiled) return tl::unexpected(compiled.error());
    return measuredFrom(experiment, **compiled, measurementOf(experiment, **compiled, scenario), atStart, scenario,
                        start, goesOn, countsUnfamiliar);
}

Expected<MeasuredRun> measuredRun(const Experiment& experiment, TrialExpressions& expressions, const BranchPoint& point,
                                  const Scenario& variant, std::uint64_t seed, const GoesOn& goesOn) {
    const std::vector<RobotInsight> none(point.before.state.robots.size());
    const Moment atBranch{
        .scenario = point.scenario.get(), .state = &point.before.state, .insights = none, .drawn = &point.drawn};
    const auto compiled = expressions.of(atBranch);
    if (!compiled) return tl::unexpected(compiled.error());
    TrialMeasurement measurement = measurementOf(experiment, **compiled, variant);
    if (point.isReached())
        return measuredFrom(experiment, **compiled, std::move(measurement), atBranch, variant,
                            branchedState(point, variant, seed), goesOn, false);  // rows do not say it
    measurement.skip();
    RunResult result = point.before;
    if (result.end == RunEnd::duration) result.end = RunEnd::noBranch;
    return MeasuredRun{std::move(result), std::move(measurement)};
}

}  // namespace mrose
