#pragma once

#include <string>

#include "scenario/scenario.h"

namespace mrose {

/// What is wrong with a state as one of a scenario: sizes, indices, numbers that are not finite. Empty: nothing, and it
/// can be stepped.
std::string misfit(const Scenario& scenario, const WorldState& state);

}  // namespace mrose
