#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assessment/compare.h"
#include "debug/opened_run.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// A real log that is to be laid over a simulation of it.
struct PlayedLogRequest {
    std::string log;             ///< its place, or its name in the folder that MROSE_DATA names; empty: the scenario's
    std::string scenario;        ///< whose robots play it; empty: one that suits the log (scenarioOfLog())
    std::string robotFile = {};  ///< of its robots, where no scenario is given
    std::vector<std::string> robots = {};  ///< only these, by their names in the log; empty: all
    std::vector<std::string> models = {};  ///< to be laid over as well: openModel()
    std::optional<std::uint64_t> seed = {};
    double pluginLimit = 2;               ///< s
    ScenarioValuePointer kept = nullptr;  ///< the scenario as a recording has it, instead of any file
};

/// A log with the scenario that plays it, ready to be opened at any instant. It never changes.
struct PlayedLog {
    PlayedLogRequest request;
    std::string place;           ///< of the log
    ScenarioValuePointer value;  ///< without what comes from the log
    std::shared_ptr<const LogWorld> played;
    std::uint64_t seed = 1;
    std::map<std::string, std::string> files;  ///< as OpenedRun::files
    std::vector<std::string> notes;            ///< what must be known before its figures are believed

    const LogWorld& world() const { return *played; }
    std::string name() const;  ///< of the log: "MRCLAM_Dataset6"
};
using PlayedLogPointer = std::shared_ptr<const PlayedLog>;

/// "session 17"; "": the log is in one piece.
std::string sessionText(const LogSession& session);
/// "MRCLAM_Dataset6, from 120.0 s": log, session and start.
std::string rolloutName(const PlayedLog& log, const RolloutRequest& rollout);

/// One rollout as a run that begins as the comparison's does. With `commandsToLogEnd` its robots get their commands up
/// to the log's end, and not to the rollout's alone. Error: as of mrose::openRollout().
Expected<OpenedRun> openRollout(const PlayedLog& log, const RolloutRequest& rollout, bool commandsToLogEnd);

}  // namespace mrose
