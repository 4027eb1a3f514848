#pragma once

#include <cstdint>

#include "io/error.h"
#include "scenario/scenario_file.h"

namespace mrose {

/// Another start of the same scenario: poses and parameters drawn uniformly round its own by Variation, the same for
/// the same `trial` on every machine. Trial 0 is the scenario itself. Starts that overlap, and those to which a wall
/// bars the straight way from the scenario's own, are drawn again. Error: a hundred draws were such.
Expected<ScenarioParts> varied(const ScenarioParts& parts, std::uint32_t trial);

/// The same with the value that gives it: what was drawn stands in it.
Expected<LoadedScenario> varied(const LoadedScenario& loaded, std::uint32_t trial);

}  // namespace mrose
