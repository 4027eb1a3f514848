#pragma once

#include "common.h"
#include "workflow/open_scenario.h"

namespace mrose::cli {

/// Flags that runs of scenarios share.
void addScenarioFlags(CLI::App& sub, ScenarioRequest& scenario, std::optional<double>& duration, std::string& until);

}  // namespace mrose::cli
