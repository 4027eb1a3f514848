#include "debug/rollout_rows.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/other_models.h"
#include "io/format.h"
#include "learning/parallel_for.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

Area areaOf(const ComparedRollout& rollout) {
    Area area{{1, 1}, {-1, -1}};
    for (const std::vector<Pose>* poses : {&rollout.real.truth, &rollout.simulated})
        for (const Pose& pose : *poses)
            if (std::isfinite(pose.x) && std::isfinite(pose.y)) area.include(position(pose));
    return area;
}

void judge(RolloutRow& row, const ComparedRollout& rollout, const DivergenceOptions& options) {
    row.bound = options.fromNetwork && row.learned ? *row.learned : options.bound;
    row.divergence = firstDivergence(rollout, WindowOptions{}.step, row.bound);
}

RolloutRow rolloutRow(const LogWorld& world, const ComparedRollout& rollout,
                      const std::vector<RolloutRequest>& requests, const DivergenceOptions& options) {
    RolloutRow row;
    row.rollout = rollout.request;
    row.robot = rollout.robot;
    row.session = requests[rollout.request].session;
    row.start = requests[rollout.request].start;
    row.use = rollout.use;
    row.path = rollout.real.path;
    row.rotation = rollout.real.rotation;
    row.length = rollout.real.steps() * WindowOptions{}.step;
    if (const double mean = knownMean(rollout); mean >= 0) row.position = mean;
    if (row.position && rollout.real.path > 0 && rollout.use != RolloutUse::still)
        row.share = 100 * *row.position / rollout.real.path;
    if (std::isfinite(rollout.errors.headingMean)) row.heading = rollout.errors.headingMean;
    if (rollout.use == RolloutUse::counted || rollout.use == RolloutUse::still) row.manoeuvre = rollout.real.manoeuvre;
    row.learned = networkBound(world, requests[rollout.request], rollout, WindowOptions{}.step, options.bound.held);
    judge(row, rollout, options);
    row.touched = rollout.touched.has_value();
    row.area = areaOf(rollout);
    return row;
}

Nanoseconds wholeSteps(double seconds) {
    const Nanoseconds step = WindowOptions{}.step;
    return std::max<Nanoseconds>(1, std::llround(seconds / toSeconds(step))) * step;
}

}  // namespace

RolloutPlan suitedPlan(const PlayedLog& log) {
    RolloutPlan plan;
    const auto length = windowsThatSuit(log.world(), wholeSteps(plan.length));
    if (!length) return plan;
    plan.length = std::round(10 * toSeconds(*length)) / 10;  // as one reads it
    for (const RolloutPlan::Cut cut : {RolloutPlan::Cut::windows, RolloutPlan::Cut::every, RolloutPlan::Cut::once}) {
        plan.cut = cut;
        if (plannedRollouts(log, plan)) break;
    }
    return plan;
}

Expected<std::vector<RolloutRequest>> plannedRollouts(const PlayedLog& log, const RolloutPlan& plan) {
    const Nanoseconds length = wholeSteps(plan.length);
    if (plan.cut == RolloutPlan::Cut::windows) return rolloutsOfAllWindows(log.world(), length);
    StretchOptions options;
    options.start = fromSeconds(plan.start);
    if (plan.cut == RolloutPlan::Cut::every) {
        options.every = length;
        if (plan.stretch) options.duration = wholeSteps(*plan.stretch);
    } else {
        options.duration = length;
    }
    auto rollouts = rolloutsOf(log.world(), options);
    // Said of the plan, not of flags.
    const std::string start = secondsText(options.start);
    if (!rollouts && plan.cut == RolloutPlan::Cut::every)
        rollouts.error().cause =
            "no rollout of " + secondsText(length) + " s fits in" +
            (plan.start > 0 ? " from " + start + " s on; expected an earlier start or" : "; expected") +
            " shorter rollouts";
    else if (!rollouts && plan.start > 0)
        rollouts.error().cause = "the ground truth ends before " + start + " s; expected an earlier start";
    return rollouts;
}

std::vector<RolloutRow> rolloutRows(const LogWorld& world, std::span<const ComparedRollout> rollouts,
                                    const std::vector<RolloutRequest>& requests, const DivergenceOptions& options) {
    std::vector<Window> windows;
    for (const ComparedRollout& rollout : rollouts) windows.push_back(rollout.real);
    classifyManoeuvres(world.log(), windows, WindowOptions{}.step);
    std::vector<std::optional<RolloutRow>> made(rollouts.size());
    parallelFor(rollouts.size(), [&](std::size_t i) {
        if (rollouts[i].use == RolloutUse::absent) return;
        made[i] = rolloutRow(world, rollouts[i], requests, options);
        if (made[i]->manoeuvre) made[i]->manoeuvre = windows[i].manoeuvre;
    });
    std::vector<RolloutRow> rows;
    for (std::optional<RolloutRow>& row : made)
        if (row) rows.push_back(std::move(*row));
    return rows;
}

void judgeRows(std::span<RolloutRow> rows, std::span<const ComparedRollout> rollouts,
               const DivergenceOptions& options) {
    std::size_t next = 0;
    for (const ComparedRollout& rollout : rollouts)
        if (rollout.use != RolloutUse::absent) judge(rows[next++], rollout, options);
}

Expected<Comparison> compareRollouts(const PlayedLog& log, const std::vector<RolloutRequest>& requests,
                                     const DivergenceOptions& bounds,
                                     const std::function<bool(std::vector<RolloutRow> rows, double share)>& report) {
    ComparisonOptions options;
    options.seed = log.seed;
    options.progress = [&](std::span<const ComparedRollout> part, double share) {
        return report(rolloutRows(log.world(), part, requests, bounds), share);
    };
    return compare(log.world(), requests, options);
}

Expected<Diagnosis> whyItLeaves(const PlayedLog& log, const CauseQuestion& question, const Progress& progress) {
    ComparisonOptions options;
    options.seed = log.seed;
    options.progress = [&](std::span<const ComparedRollout>, double) { return !progress || progress(0); };
    RolloutRequest alone = question.request;
    alone.robot = question.row.robot;
    const auto comparison = compare(log.world(), {&alone, 1}, options);
    if (!comparison) return tl::unexpected(comparison.error());
    const ComparedRollout& rollout = comparison->rollouts.front();
    DiagnosisOptions asked;
    asked.seed = log.seed;
    asked.bound = question.row.bound;
    asked.models = question.models;
    asked.progress = progress;
    if (progress && !progress(0)) return fail(log.place, "was not looked through: cancelled");
    return diagnose(log.world(), alone, rollout, *question.row.divergence, asked);
}

bool playsToLogEnd(const RolloutPlan& plan, bool restarts) { return plan.cut != RolloutPlan::Cut::every || !restarts; }

}  // namespace mrose
