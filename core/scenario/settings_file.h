#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/error.h"
#include "io/value.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// Values for places in a scenario, as `mrose tune` finds them for a controller's parameters.
struct Settings {
    std::string file, name;
    std::vector<std::pair<std::string, Value>> set;  ///< by paths, as of --set; a value knows its line

    /// The scenario with them. Error: file, line and path of the first that has no place there.
    Expected<ScenarioValue> putInto(const ScenarioValue& value) const;
    /// What was found wrong with a scenario that they were put into: of their file, line and path where they made it
    /// so, else as it is.
    Error placed(const Error& error, const ScenarioValue& with) const;
    /// What is wrong with one of them.
    Error about(const std::string& path, const Value& value, std::string cause) const;
};

/// Of `format = "mrose settings"`; what it says as evidence is for people. Error: file, line, column and key of the
/// first thing wrong.
Expected<Settings> readSettings(const Value& content, const std::string& file);

}  // namespace mrose
