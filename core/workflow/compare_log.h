#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/compared_divergences.h"
#include "io/progress.h"
#include "report/evaluation_report.h"
#include "workflow/plugins.h"

namespace mrose {

/// Instead of a file of windows: as `mrose evaluate` cuts the log.
constexpr const char* allWindows = "all";

/// When a simulated robot is said to have left the real trajectory, and whether the causes are looked for.
struct DivergenceRequest {
    std::optional<double> position, heading;  ///< m, degrees; neither: what the networks know of real runs
    double held = 0.3;                        ///< s
    bool noCauses = false;
    std::vector<std::string> models = {};  ///< that may explain it, beside those of modelsToTry(): network files
};

/// Which scenario is to be put beside which log, and which rollouts of it.
struct CompareRequest {
    std::string scenario, log;             ///< no scenario: one that is made for the log
    std::string robotFile = {};            ///< what kind its robots are then, where the log does not say it
    std::string windows = {};              ///< a file of windows, one rollout each; or allWindows; empty: a stretch
    std::vector<std::string> robots = {};  ///< of the log, by name; empty: all that are played
    double start = 0;                      ///< s, on the session's clock
    std::optional<double> duration = {}, every = {};
    std::optional<std::uint64_t> seed = {};  ///< nullopt: the scenario's
    DivergenceRequest divergence = {};
    PluginUse plugins = {};
    std::string command = {};  ///< what a report says that it was made by
};

/// What a report is written from, and what further questions are asked of.
struct LogComparison {
    LogWorld world;
    Comparison comparison;
    ComparedDivergences divergences;
    ReportContext context;
};

/// How a comparison is watched and ended: first its rollouts are driven, then the causes looked for.
struct CompareProgress {
    Progress drives = {}, diagnoses = {};
};

/// Opens scenario and log, drives the rollouts, and finds where they diverge and why. Error: a file; those of
/// LogWorld::create(), rolloutsOf(), requestedRollouts(), compare() and divergencesOf(); it was cancelled.
Expected<LogComparison> compareLog(const CompareRequest& request, const CompareProgress& progress = {});

}  // namespace mrose
