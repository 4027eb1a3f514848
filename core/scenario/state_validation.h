#pragma once

#include <string>

#include "scenario/scenario.h"

namespace mrose {

/// What is wrong with a state as one of a scenario: sizes, indices, instants beyond all runs, numbers that are not
/// finite or larger than any that occur. Empty: nothing, and it can be stepped.
std::string validate(const Scenario& scenario, const WorldState& state);

}  // namespace mrose
