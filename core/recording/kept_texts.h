#pragma once

#include <map>
#include <string>

#include "io/error.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// The descriptions of a recording from before scenarios were values: texts by the names that they were found by, the
/// scenario's among them, and the number of a batch's trial.
using KeptTexts = std::map<std::string, std::string>;

/// The scenario that they give. Error: as of loadScenario() and varied().
Expected<ScenarioValue> scenarioOfTexts(const std::string& scenario, const KeptTexts& texts);

}  // namespace mrose
