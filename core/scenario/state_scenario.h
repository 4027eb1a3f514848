#pragma once

#include <filesystem>

#include "io/error.h"
#include "scenario/description_source.h"
#include "scenario/scenario.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// The scenario that begins with this state of a run of `value`: robots start where they are in it.
Expected<ScenarioValue> withState(const ScenarioValue& value, const Scenario& scenario, const WorldState& state);

/// Writes a scenario that begins with this state of a run: `path`, NAME.toml, says what `value` says, with
/// `initial_state = "NAME.state"`, beside which the state lies, which holds all of it, too, and runs by itself. Files
/// are named by their full paths where they lie on the disk as the value has them, by their names where they ship so,
/// and are written beside otherwise. A run of it goes on as the run would have, tick by tick, its ticks counted on.
/// `disk` knows what lies there and what ships. Error: what the system says; what was written would go on otherwise, as
/// where a controller was replaced by hand.
Expected<void> saveStateAsScenario(const std::filesystem::path& path, const ScenarioValue& value,
                                   const Scenario& scenario, const WorldState& state, DescriptionSource& disk);

}  // namespace mrose
