#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assessment/compare.h"
#include "report/evaluation_report.h"
#include "scenario/scenario_file.h"

namespace mrose {

/// Instead of a file of windows: as `mrose evaluate` cuts the log.
constexpr const char* allWindows = "all";

/// Which scenario is to be put beside which log, and which rollouts of it.
struct LogComparisonRequest {
    std::string scenario, log;             ///< no scenario: one that is made for the log
    std::string robotFile = {};            ///< what kind its robots are then, where the log does not say it
    std::string windows = {};              ///< a file of windows, one rollout each; or allWindows; empty: a stretch
    std::vector<std::string> robots = {};  ///< of the log, by name; empty: all that are played
    double start = 0;                      ///< s, on the session's clock
    std::optional<double> duration = {}, every = {};
    std::optional<std::uint64_t> seed = {};  ///< nullopt: the scenario's
};

/// How controllers in shared libraries are loaded, and what is to be reported of what was loaded.
struct LogComparisonPlugins {
    PluginLoader load;
    std::function<void(ScenarioParts&)> loaded = {};
};

/// What a report is written from, and what further questions are asked of.
struct LogComparison {
    LogWorld world;
    Comparison comparison;
    ReportContext context;
};

/// Opens scenario and log, and drives the rollouts. `commandLine`: what the report says that it was made by. `goesOn`:
/// see compare(). Error: a file; those of LogWorld::create(), rolloutsOf(), requestedRollouts() and compare().
Expected<LogComparison> compareLog(const LogComparisonRequest& request, const LogComparisonPlugins& plugins,
                                   const std::string& commandLine,
                                   const std::function<bool(double share)>& goesOn = {});

}  // namespace mrose
