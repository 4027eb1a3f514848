#pragma once

#include <filesystem>

#include "io/error.h"
#include "scenario/description_texts.h"
#include "scenario/scenario.h"

namespace mrose {

/// Writes a scenario that begins with this state of a run: `path`, NAME.toml, is the run's own text with
/// `initial_state = "NAME.state"`, beside which the state lies. Files that the text names are named by their full paths
/// where they lie on the disk as they were read, by their names where they ship, and are written beside otherwise. A
/// run of it goes on as the run would have, tick by tick, its ticks counted on. Error: what the system says; a scenario
/// that is not as its descriptions say (a trial of a batch): it would go on otherwise.
Expected<void> saveStateAsScenario(const std::filesystem::path& path, const Descriptions& descriptions,
                                   const Scenario& scenario, const WorldState& state);

}  // namespace mrose
