#include "experiment/branching.h"

#include "experiment/trial_run.h"
#include "scenario/carry_over.h"

namespace mrose {

RunOptions untilBranch(Condition& branch, const Experiment& experiment, const Scenario& scenario,
                       const DrawnValues& drawn) {
    RunOptions options;
    options.duration = experiment.branchWithin;
    options.drawn = &drawn;
    options.endOnFault = true;
    options.every = ticksBetweenLooks(experiment, scenario.scene());
    options.watchFollows = readsInsights(experiment.branch.text, scenario);
    options.watch = [&](const Moment& at) -> Expected<bool> {
        auto holds = branch.holds(at);
        if (!holds) return tl::unexpected(experiment.branch.placed(holds.error(), experiment.file));
        return holds;
    };
    return options;
}

Expected<BranchPoint> runToBranch(const Experiment& experiment, TrialExpressions& expressions, ScenarioParts before,
                                  const DrawnValues& drawn, const std::function<bool()>& goesOn) {
    auto scenario = std::make_shared<const Scenario>(std::move(before));
    WorldState start = scenario->initialState();
    const std::vector<RobotInsight> none(start.robots.size());
    const auto compiled =
        expressions.of({.scenario = scenario.get(), .state = &start, .insights = none, .drawn = &drawn});
    if (!compiled) return tl::unexpected(compiled.error());
    RunOptions options = untilBranch(*(*compiled)->branch, experiment, *scenario, drawn);
    std::optional<Error> failed;
    options.watch = [&, watch = options.watch](const Moment& at) -> Expected<bool> {
        const auto holds = watch(at);
        if (!holds) failed = holds.error();
        return !holds || *holds;
    };
    options.goesOn = [&](const WorldState&) { return !goesOn || goesOn(); };
    auto result = run(*scenario, start, options);
    if (!result) return tl::unexpected(result.error());
    if (failed) endByFault(*result, *failed);
    BranchPoint point{std::move(scenario), std::move(*result), drawn};
    point.drawn.back().value = toSeconds(point.scenario->scene().timeOf(point.before.state.tick));
    return point;
}

WorldState branchedState(const BranchPoint& point, const Scenario& variant, std::uint64_t seed) {
    WorldState state = carriedOver(*point.scenario, point.before.state, variant);
    state.seed = seed;
    return state;
}

}  // namespace mrose
