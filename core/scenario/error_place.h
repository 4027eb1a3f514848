#pragma once

#include <string>

#include "scenario/scenario_value.h"

namespace mrose {

/// Whether an error about a scenario, or about a file that it names, is of what stands at a path of its value, or
/// within that.
bool isWithin(const ScenarioValue& value, const Error& error, const std::string& path);

}  // namespace mrose
