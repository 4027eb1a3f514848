#pragma once

#include <string>

#include "scenario/scenario_value.h"

namespace mrose {

/// Whether `key`, as an error about a scenario names it, is at a path of its value or within what stands there.
bool isWithin(const ScenarioValue& value, std::string key, const std::string& path);

}  // namespace mrose
