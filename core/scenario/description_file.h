#pragma once

#include <string>
#include <variant>

#include "io/error.h"
#include "scenario/robot_file.h"
#include "scenario/scenario_file.h"
#include "scene/environment.h"

namespace mrose {

/// What a description file may hold.
using Description = std::variant<Shape, Environment, RobotDescription, LoadedScenario>;

/// Loads a description file of any kind, which its key `format` says. Error: the first thing wrong.
Expected<Description> loadDescription(const std::string& name, DescriptionSource& source,
                                      const ScenarioLoading& loading = {});

}  // namespace mrose
