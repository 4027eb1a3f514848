#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "io/error.h"
#include "scenario/description_source.h"
#include "scenario/scenario.h"

namespace mrose {

/// A scenario with all texts that say what it is: KeptDescriptions of them under the same name give it again, without
/// any disk.
struct LoadedScenario {
    std::string name;  ///< of its own text
    ScenarioParts parts;
    std::map<std::string, std::string> texts;
};

/// Makes the controller that a shared library holds, from its path and its options as TOML. Error: where an option is
/// wrong, its key is the option's.
using PluginLoader =
    std::function<Expected<std::shared_ptr<const Controller>>(const std::string& path, const std::string& options)>;

struct ScenarioLoading {
    /// Empty: shared libraries are not loaded, and robots of plug-ins keep whatever command is in force: for replays.
    PluginLoader plugins = {};
    /// False: no log is read. Robots that play one are told nothing and stand at the origin: for who opens the log at
    /// another instant.
    bool playLogs = true;
};

/// Loads the scenario file called `name` (resources/README.md explains the keys), or the one of that name that ships,
/// with every file that it names. Error: file, line, column and key of the first thing wrong in any of them.
Expected<LoadedScenario> loadScenario(const std::string& name, DescriptionSource& source,
                                      const ScenarioLoading& loading = {});

}  // namespace mrose
