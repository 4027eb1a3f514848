#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiment/run.h"
#include "experiment/trial_run.h"
#include "workflow/open_scenario.h"

namespace mrose {

/// How long a scenario is run, from where, and what is kept of it.
struct RunRequest {
    ScenarioRequest scenario;
    std::optional<double> duration = {};     ///< s; otherwise what the scenario says
    std::optional<std::uint64_t> seed = {};  ///< likewise
    std::string until = {};                  ///< a condition that ends the run; empty: none
    bool endOnFault = false, checkRewind = false;
    std::string recording = {};  ///< the file to be written; empty: none
    bool overwrite = false;      ///< of one that is there already
    std::string command = {};    ///< what the recording says that it was made by
};

/// How a run is watched and ended. Each may be empty.
struct RunWatch {
    std::function<void(const OpenedScenario&)> opened = {};
    /// It begins: from this state, for so many ticks. `flush` puts what was recorded so far onto the disk, until
    /// runScenario() returns; programs whose run keeps pace with the clock call it about once a second.
    std::function<void(const WorldState& initial, std::int64_t ticks, const std::function<void()>& flush)> begins = {};
    std::function<bool(const WorldState&)> each = {};  ///< after every tick; false ends the run
    std::function<void(const Error&)> lost = {};       ///< the recording, from here on or at its end; the run goes on
};

struct ScenarioRun {
    OpenedScenario opened;
    RunResult result;
    std::vector<MeasuredValue> measured;  ///< of a trial of an experiment, as in its row if it ran to its end
    bool recorded = false;                ///< the recording is there and whole
    std::optional<Error> lost;            ///< why it is not
    const Scenario& scenario() const { return *opened.scenario; }
};

/// Error: as of openScenario(); the condition; an expression of a trial's experiment; the recording cannot be begun, or
/// is one of the files that are read.
Expected<ScenarioRun> runScenario(const RunRequest& request, const RunWatch& watch = {});

/// Error: `text` is no condition that can be asked of the scenario; none is one. Its source is the flag --until.
Expected<std::optional<Condition>> openCondition(const std::string& text, const Scenario& scenario);

/// What RunRequest::checkRewind found, a sentence each: "tick 150 cannot be taken back: robot ...".
std::vector<std::string> hiddenText(const Scenario& scenario, const RunResult& result);

}  // namespace mrose
