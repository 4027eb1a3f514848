#pragma once

#include "common.h"
#include "workflow/open_scenario.h"

namespace mrose::cli {

/// What is other in a scenario than its file says: --settings and --set.
void addChangeFlags(CLI::App& sub, std::vector<std::string>& settings, std::vector<std::string>& overrides);

/// Flags that runs of scenarios share.
void addScenarioFlags(CLI::App& sub, ScenarioRequest& scenario, std::optional<double>& duration, std::string& until);

}  // namespace mrose::cli
