#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scenario/scenario_file.h"

namespace mrose {

/// A sentence for each body that starts outside the walls, of the first ten: most are a mistake.
std::vector<std::string> startsOutsideText(const Scene& scene);

/// Of a scenario that goes on from a saved state: a sentence where a robot's start line is not where it stands in it.
std::vector<std::string> startsApartText(const LoadedScenario& loaded);

/// Loads plug-ins that a recording names from wherever they are found: as they were named, seen from the current
/// folder; the same seen from the recording's; beside the recording. Error: all places where there is none.
PluginLoader findingLoader(const std::filesystem::path& recording, PluginLoader load);

}  // namespace mrose
