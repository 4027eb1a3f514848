#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "workflow/plugins.h"

namespace mrose {

/// A scenario that is to be run, and what is other than its file says.
struct ScenarioRequest {
    std::string file;                         ///< or the name of one that ships
    std::string log = {};                     ///< read instead of those that it names
    std::vector<std::string> overrides = {};  ///< "PATH=VALUE", as of parseOverride()
    std::uint32_t trial = 0;                  ///< starts as this trial of a batch does; 0: as it is written
    PluginUse plugins = {};
};

/// A scenario ready to run.
struct OpenedScenario {
    LoadedScenario loaded;
    std::map<std::string, std::string> plugins;  ///< hashes of their files' contents, by path
    std::shared_ptr<const Scenario> scenario;
    std::vector<std::string> notes;  ///< what is most likely a mistake, a sentence each
};

/// Error: the first thing wrong in any file that it is made from, or in an override.
Expected<OpenedScenario> openScenario(const ScenarioRequest& request);
/// The same of descriptions from elsewhere than the disk, instead of `request.log` too.
Expected<OpenedScenario> openScenario(const ScenarioRequest& request, DescriptionSource& source);

/// A sentence for each body that starts outside the walls, of the first ten: most are a mistake.
std::vector<std::string> startsOutsideText(const Scene& scene);

}  // namespace mrose
