#include "experiment/trial_run.h"

#include <algorithm>
#include <optional>

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

Expected<MeasuredRun> measuredRun(const Experiment& experiment, TrialExpressions& expressions, const Scenario& scenario,
                                  const DrawnValues& drawn, std::uint64_t seed, const GoesOn& goesOn) {
    const WorldState start = scenario.initialState(seed);
    std::vector<RobotInsight> none(start.robots.size());
    const Moment atStart{.scenario = &scenario, .state = &start, .insights = none, .drawn = &drawn};
    const auto compiled = expressions.of(atStart);
    if (!compiled) return tl::unexpected(compiled.error());
    const std::int64_t every = ticksBetweenLooks(experiment, scenario.scene());
    TrialMeasurement measurement(experiment, **compiled, every * scenario.scene().tickLength);
    if (const auto begun = measurement.begin(atStart); !begun) return tl::unexpected(begun.error());
    RunOptions options;
    options.duration = scenario.parts().duration;
    options.endOnFault = true;
    options.watchFollows = (*compiled)->follows;
    options.every = every;
    options.drawn = &drawn;
    options.watch = [&](const Moment& at) { return measurement.look(at); };
    std::optional<Error> wrong;
    options.finally = [&](const Moment& at) {
        if (const auto ended = measurement.end(at); !ended) wrong = ended.error();
    };
    options.each = [&](const WorldState&, const StepTrace&) { return !goesOn || goesOn(); };
    auto result = run(scenario, start, options);
    if (!result) return tl::unexpected(result.error());
    if (wrong) return tl::unexpected(*wrong);
    return MeasuredRun{std::move(*result), std::move(measurement)};
}

}  // namespace mrose
