#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "debug/rollout_rows.h"
#include "workflow/open_run.h"

namespace mrose {

/// Error: the first thing wrong with log or scenario, or with both together. One is that the log does not say what kind
/// of robot drove, and that the request does not either: then `kindUnknown`, if given, is true.
Expected<PlayedLogPointer> openPlayedLog(const PlayedLogRequest& request, const OpenProgress& progress = {},
                                         bool* kindUnknown = nullptr);

/// A log with its rollouts, and one of them as a run.
struct OpenedLog {
    PlayedLogPointer world;
    RolloutPlan plan;
    std::vector<RolloutRequest> requests;
    std::size_t rollout = 0;
    OpenedRun run;
};
/// Its first rollout; `asked`: none, then the plan that suits it. Error, and `kindUnknown`: as of openPlayedLog();
/// no rollout of the plan fits in; the first one cannot be opened.
Expected<OpenedLog> openLogAsRun(const PlayedLogRequest& request, const std::optional<RolloutPlan>& asked = {},
                                 bool restarts = true, const OpenProgress& progress = {}, bool* kindUnknown = nullptr);

/// A log and its scenario once more from their files, with the rollout that was shown.
/// The rollout of `shown`'s start, of trajectory and robot by their names. Error: a file; there is no such rollout now.
Expected<OpenedLog> reopen(const PlayedLog& before, const RolloutPlan& plan, const RolloutRequest& shown, bool restarts,
                           const OpenProgress& progress);

}  // namespace mrose
