#include "debug/rollout_breaks.h"

#include <algorithm>
#include <utility>

#include "debug/play_end.h"

namespace mrose {
namespace {

/// After so many steps of the comparison; nullopt: unknown.
std::optional<PoseError> errorAfter(const BranchTree& branches, std::uint32_t branch, const Reality& reality,
                                    const LeavingRobots::Robot& robot, std::int64_t steps) {
    const Scene& scene = branches.record(branch).setup().scene();
    const Nanoseconds now = steps * WindowOptions{}.step;
    const Reality::Robot* const real = reality.robotNamed(robot.name);
    const std::uint32_t body = bodyNamed(scene, robot.name);
    const auto truth = real != nullptr ? real->poseAt(now) : std::nullopt;
    const auto simulated = branches.posesAt(branch, scene.ticksOf(now));
    if (!truth || !simulated || body >= simulated->size()) return {};
    return poseError(*truth, (*simulated)[body]);
}

bool hasLeft(const BranchTree& branches, std::uint32_t branch, std::int64_t tick, const Reality& reality,
             const LeavingRobots::Robot& robot) {
    using State = DivergenceRule::State;
    const Nanoseconds step = WindowOptions{}.step;
    DivergenceRule rule(robot.bound.held);
    for (std::int64_t k = branches.record(branch).setup().scene().timeOf(tick) / step; k >= 1; --k) {
        const auto error = errorAfter(branches, branch, reality, robot, k);
        if (!error) continue;
        const State state = rule.add(k * step, *error, robot.bound.at(static_cast<std::size_t>(k - 1)));
        if (state != State::beyond) return state == State::left;
    }
    return false;
}

bool leaves(const BranchTree& branches, std::uint32_t branch, std::int64_t tick, const LeavingRobots& leaving,
            const LeavingRobots::Robot& robot) {
    const Scene& scene = branches.record(branch).setup().scene();
    if (branch == leaving.compared) return robot.leaves && scene.ticksOf(*robot.leaves) == tick;
    return leaving.reality && hasLeft(branches, branch, tick, *leaving.reality, robot);
}

/// Whether there is one in a run that stands at its beginning.
Expected<bool> hasBreak(TimeTravel& run, Breakpoints& breakpoints, const BreakWish& wish, const GoesOn& goesOn) {
    const auto progress = [&](double) { return goesOn(); };
    const std::int64_t end = usualEnd(run);
    while (run.tick() < end) {
        if (!wish.back) breakpoints.leave(run);
        if (auto done = run.forward(); !done) return tl::unexpected(done.error());
        if (wish.back) continue;
        const auto arrival = breakpoints.arrive(run, progress);
        if (!arrival) return tl::unexpected(arrival.error());
        if (arrival->why || !arrival->known) return arrival->known;
    }
    if (!wish.back) return false;
    const auto met = breakpoints.last(wish, run, end + 1, progress);
    if (!met) return tl::unexpected(met.error());
    return met->has_value();
}

}  // namespace

LeavingRobots leavingRobots(const LogWorld& world, std::span<const RolloutRow> rowsOfRollout) {
    LeavingRobots leaving;
    leaving.real = world.log().real();
    for (const RolloutRow& row : rowsOfRollout)
        leaving.robots.push_back({world.robots()[row.robot].name, row.bound,
                                  row.divergence ? std::optional(row.divergence->time) : std::nullopt});
    return leaving;
}

TickPredicate leavesReality(const LeavingRobots& leaving) {
    return [leaving](const BranchTree& branches, std::uint32_t branch, std::int64_t tick) {
        return std::any_of(leaving.robots.begin(), leaving.robots.end(),
                           [&](const auto& robot) { return leaves(branches, branch, tick, leaving, robot); });
    };
}

TickText whoLeaves(const LeavingRobots& leaving) {
    return [leaving](const BranchTree& branches, std::uint32_t branch, std::int64_t tick) {
        std::string names;
        std::size_t count = 0;
        for (const LeavingRobots::Robot& robot : leaving.robots) {
            if (!leaves(branches, branch, tick, leaving, robot) || leaves(branches, branch, tick - 1, leaving, robot))
                continue;
            names += (names.empty() ? "" : ", ") + robot.name;
            ++count;
        }
        return names + (count == 1 ? " leaves the " : " leave the ") + leaving.real + " trajectory";
    };
}

Expected<RolloutFound> rolloutWithBreak(const PlayedLog& log, const RolloutSearch& search, const Progress& progress) {
    RolloutFound found{{}, search.hits};
    for (std::size_t i = 0; i < search.places.size(); ++i) {
        const RolloutSearch::Place& place = search.places[i];
        const auto goesOn = [&] {
            return mayGoOn(progress, static_cast<double>(i) / static_cast<double>(search.places.size()));
        };
        if (!goesOn()) return found;
        const auto opened = openRollout(log, place.request, false);
        if (!opened) continue;
        TimeTravel run(*opened);
        Breakpoints breakpoints;
        breakpoints.replace(search.breakpoints);
        breakpoints.setDivergence({place.diverged, {}});
        breakpoints.setHitsInOtherRuns(found.hits.elsewhere(place.rollout));
        const auto has = hasBreak(run, breakpoints, search.wish, goesOn);
        if (!has) return tl::unexpected(has.error());
        if (*has) {
            found.rollout = place.rollout;
            return found;
        }
        if (!search.wish.back)
            found.hits.learn(place.rollout, breakpoints.states(run, run.branches().marks(run.branch())));
    }
    return found;
}

}  // namespace mrose
