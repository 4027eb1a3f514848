#pragma once

#include <functional>
#include <span>
#include <vector>

#include "io/progress.h"
#include "workflow/overlay_models.h"
#include "workflow/overlay_rows.h"

namespace mrose {

// What an overlay has done in other threads: from values; it asks now and then whether it is still wanted.

/// The rollouts of a plan driven as `mrose compare` does; rows of those that are done. Error: as of compare().
Expected<Comparison> compareRollouts(const OverlayWorld& overlay, const std::vector<RolloutRequest>& requests,
                                     const DivergenceOptions& bounds,
                                     const std::function<bool(std::vector<OverlayRow> rows, double share)>& report);

/// How true a model is. What is known of it already is left out: `compared` of the scenario's own.
OverlayModel::Figures judge(const OverlayWorld& overlay, const OverlayModel& model,
                            const std::vector<RolloutRequest>& requests, Nanoseconds horizon, const Progress& progress);

/// Of which robot it is asked why it leaves the real trajectory, and what else it might have moved by.
struct CauseQuestion {
    RolloutRequest request;
    OverlayRow row;
    DivergenceOptions bounds;
    std::vector<OverlayModel> models;
};
/// Error: as of compare() and diagnose().
Expected<Diagnosis> whyItLeaves(const OverlayWorld& overlay, const CauseQuestion& question, const Progress& progress);

/// A log with its rollouts, and one of them as a run.
struct OpenedLog {
    OverlayWorldPointer world;
    OverlayPlan plan;
    std::vector<RolloutRequest> requests;
    std::size_t rollout = 0;
    OpenRun run;
};
/// Its first rollout; `asked`: none, then the plan that suits it. Error, and `kindUnknown`: as of openOverlayWorld();
/// no rollout of the plan fits in; the first one cannot be opened.
Expected<OpenedLog> openLogAsRun(const OverlayRequest& request, const std::optional<OverlayPlan>& asked, bool restarts,
                                 const OpenProgress& progress, bool& kindUnknown);

/// A robot's commands do not end with a rollout after which no other begins.
bool playsToLogEnd(const OverlayPlan& plan, bool restarts);

/// A log and its scenario once more from their files, with the rollout that was shown.
/// The rollout of `shown`'s start, of trajectory and robot by their names. Error: a file; there is no such rollout now.
Expected<OpenedLog> reopen(const OverlayWorld& before, const OverlayPlan& plan, const RolloutRequest& shown,
                           bool restarts, const std::function<bool()>& goesOn);

}  // namespace mrose
