#include "workflow/overlay_work.h"

#include <algorithm>

#include "io/format.h"
#include "workflow/motion_models.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// Half of the work, the first or the second.
Progress halfOf(const Progress& progress, double from) {
    return [&progress, from](double share) { return progress(from + share / 2); };
}

bool isSameRollout(const LogWorld& before, const RolloutRequest& was, const LogWorld& now, const RolloutRequest& is) {
    if (was.start != is.start || was.robot.has_value() != is.robot.has_value()) return false;
    if (was.robot && before.robots()[*was.robot].name != now.robots()[*is.robot].name) return false;
    return before.trajectory(was.session, 0).name == now.trajectory(is.session, 0).name;
}

/// What a robot might have moved by: what suits it, and what is laid over.
std::vector<OtherModel> modelsOf(const OverlayWorld& overlay, const std::vector<OverlayModel>& laidOver) {
    auto models = modelsToTry(overlay.world(), {}).value_or(std::vector<OtherModel>{});
    for (const OverlayModel& laid : laidOver)
        if (!laid.moves.byRobot.empty() && std::none_of(models.begin(), models.end(), [&](const OtherModel& model) {
                return model.name == laid.name;
            }))
            models.push_back(laid.moves);
    return models;
}

}  // namespace

Expected<Comparison> compareRollouts(const OverlayWorld& overlay, const std::vector<RolloutRequest>& requests,
                                     const DivergenceOptions& bounds,
                                     const std::function<bool(std::vector<OverlayRow> rows, double share)>& report) {
    ComparisonOptions options;
    options.seed = overlay.seed;
    options.progress = [&](std::span<const ComparedRollout> part, double share) {
        return report(overlayRows(overlay.world(), part, requests, bounds), share);
    };
    return compare(overlay.world(), requests, options);
}

OverlayModel::Figures judge(const OverlayWorld& overlay, const OverlayModel& model,
                            const std::vector<RolloutRequest>& requests, Nanoseconds horizon,
                            const Progress& progress) {
    OverlayModel::Figures figures;
    const bool own = model.world == overlay.played;
    if (!own) {
        ComparisonOptions options;
        options.seed = overlay.seed;
        options.progress = [&](std::span<const ComparedRollout>, double share) { return progress(share / 2); };
        figures.compared =
            compare(*model.world, requests, options).map([](const Comparison& comparison) { return comparison.all; });
    }
    figures.evaluated = evaluatedModel(overlay, model, horizon, own ? progress : halfOf(progress, 0.5));
    return figures;
}

Expected<Diagnosis> whyItLeaves(const OverlayWorld& overlay, const CauseQuestion& question, const Progress& progress) {
    ComparisonOptions options;
    options.seed = overlay.seed;
    options.progress = [&](std::span<const ComparedRollout>, double) { return progress(0); };
    RolloutRequest alone = question.request;
    alone.robot = question.row.robot;
    const auto comparison = compare(overlay.world(), {&alone, 1}, options);
    if (!comparison) return tl::unexpected(comparison.error());
    const ComparedRollout& rollout = comparison->rollouts.front();
    DiagnosisOptions asked;
    asked.seed = overlay.seed;
    asked.bound = boundFor(overlay.world(), rollout, question.bounds, WindowOptions{}.step);
    asked.models = modelsOf(overlay, question.models);
    asked.progress = progress;
    if (!progress(0)) return fail(overlay.place, "was not looked through: cancelled");
    return diagnose(overlay.world(), alone, rollout, *question.row.divergence, asked);
}

bool playsToLogEnd(const OverlayPlan& plan, bool restarts) { return plan.cut != OverlayPlan::Cut::every || !restarts; }

Expected<OpenedLog> openLogAsRun(const OverlayRequest& request, const std::optional<OverlayPlan>& asked, bool restarts,
                                 const OpenProgress& progress, bool& kindUnknown) {
    auto world = openOverlayWorld(request, progress, &kindUnknown);
    if (!world) return tl::unexpected(world.error());
    const OverlayPlan plan = asked ? *asked : suitedPlan(**world);
    auto requests = plannedRollouts(**world, plan);
    if (!requests) return tl::unexpected(requests.error());
    auto run = openRollout(**world, requests->front(), playsToLogEnd(plan, restarts));
    if (!run) return tl::unexpected(run.error());
    return OpenedLog{std::move(*world), plan, std::move(*requests), 0, std::move(*run)};
}

Expected<OpenedLog> reopen(const OverlayWorld& before, const OverlayPlan& plan, const RolloutRequest& shown,
                           bool restarts, const std::function<bool()>& goesOn) {
    OpenProgress progress;
    progress.goesOn = goesOn;
    auto world = openOverlayWorld(before.request, progress);
    if (!world) return tl::unexpected(world.error());
    auto requests = plannedRollouts(**world, plan);
    if (!requests) return tl::unexpected(requests.error());
    const auto same = std::find_if(requests->begin(), requests->end(), [&](const RolloutRequest& request) {
        return isSameRollout(before.world(), shown, (*world)->world(), request);
    });
    if (same == requests->end()) {
        const std::string& session = before.world().trajectory(shown.session, 0).name;
        return fail((*world)->place, "has no rollout from " + secondsText(shown.start) + " s" +
                                         (session.empty() ? "" : " of \"" + session + '"') + " any more");
    }
    auto run = openRollout(**world, *same, playsToLogEnd(plan, restarts));
    if (!run) return tl::unexpected(run.error());
    const auto rollout = static_cast<std::size_t>(same - requests->begin());
    return OpenedLog{std::move(*world), plan, std::move(*requests), rollout, std::move(*run)};
}

}  // namespace mrose
