#pragma once

#include <functional>
#include <memory>
#include <string>

#include "io/error.h"
#include "scenario/description_source.h"
#include "scenario/scenario.h"
#include "scenario/scenario_value.h"

namespace mrose {

class DescriptionLibrary;

/// A scenario as a value, and what is made of it.
struct LoadedScenario {
    ScenarioValue value;
    ScenarioParts parts;
};

/// Makes the controller that a shared library holds, from its path and its options as TOML. Error: where an option is
/// wrong, its key is the option's.
using PluginLoader =
    std::function<Expected<std::shared_ptr<const Controller>>(const std::string& path, const std::string& options)>;

struct ScenarioLoading {
    /// Empty: shared libraries are not loaded, and robots of plug-ins keep whatever command is in force: for replays.
    PluginLoader plugins = {};
    /// False: no log is read. Robots that play one get no commands and stand at the origin: for who opens the log at
    /// another instant.
    bool playLogs = true;
    /// False: bodies may overlap at the start. The caller looks (start_check.h).
    bool checkStarts = true;
};

/// Loads the scenario file called `name` (resources/README.md explains the keys), or the one of that name that ships,
/// with every file that it names; or the scenario that a value file or a state file holds (value_file.h). Error: file,
/// line, column and key of the first thing wrong in any of them.
Expected<LoadedScenario> loadScenario(const std::string& name, DescriptionSource& source,
                                      const ScenarioLoading& loading = {});

/// The same of a value. What it names and does not hold itself comes from `source`, without one from nowhere; the value
/// given back holds it.
Expected<LoadedScenario> loadScenario(const ScenarioValue& value, DescriptionSource& source,
                                      const ScenarioLoading& loading = {});
Expected<LoadedScenario> loadScenario(const ScenarioValue& value, const ScenarioLoading& loading = {});
/// The same with a library that keeps what it has read, for who loads many.
Expected<LoadedScenario> loadScenario(const ScenarioValue& value, DescriptionLibrary& library,
                                      const ScenarioLoading& loading = {});

}  // namespace mrose
