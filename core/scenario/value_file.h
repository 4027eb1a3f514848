#pragma once

#include <optional>
#include <string>

#include "io/error.h"
#include "io/value.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// A scenario with all that it is made of in one file, a TOML text of `format = "mrose scenario value"`: loadScenario()
/// opens it wherever it lies, without the files that it was made from.
std::string valueFileText(const ScenarioValue& value);

/// A value as a text within such a file, or within a state file, and back. nullopt: it is damaged.
std::string encoded(const ScenarioValue& value);
std::optional<ScenarioValue> decoded(const std::string& text);

/// The scenario that a description says: its own; that of a value file; or that which a state file (saved_state.h) goes
/// on with, from there. Error: file, line and key of the first thing wrong.
Expected<ScenarioValue> scenarioOf(const Value::File& description, const std::string& shown);

}  // namespace mrose
