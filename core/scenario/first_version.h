#pragma once

#include <string>
#include <string_view>

#include "io/error.h"
#include "scenario/scenario.h"
#include "world/state_hash.h"

namespace mrose {

/// A state of a scenario from its bytes (state_bytes.h), laid out for it also where they are of the first version.
/// Whether its sizes are the scenario's is not asked (state_validation.h). Error: as of parseState().
Expected<WorldState> parseStateOf(const Scenario& scenario, std::string_view bytes, const std::string& name);

/// The hash that a state of the scenario had in the first version.
StateHash firstVersionHash(const Scenario& scenario, const WorldState& state);

}  // namespace mrose
