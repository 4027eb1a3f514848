#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common.h"
#include "condition/condition.h"
#include "plugins.h"
#include "scenario/scenario.h"
#include "scenario/scenario_file.h"
#include "simulation/run_statistics.h"

namespace mrose::cli {

/// A scenario ready to run.
struct OpenScenario {
    LoadedScenario loaded;
    std::map<std::string, std::string> plugins;  ///< hashes of their files' contents, by path
    std::shared_ptr<const Scenario> scenario;
};

/// One line on standard error for each body that starts outside the walls: most are a mistake.
void sayStartsOutside(const Scene& scene);

/// Flags that runs of scenarios share.
struct RunFlags {
    std::string scenario, log, until;
    std::vector<std::string> overrides;  ///< "PATH=VALUE", as in ScenarioValue::overridden()
    std::optional<double> duration;
    std::optional<std::uint64_t> seed;
    std::uint32_t trial = 0;
    PluginFlags plugins;
};
void addRunFlags(CLI::App& sub, RunFlags& flags);

/// Loads the scenario file that the flags name, or the one of that name that ships, with what they override, as its
/// trial `trial` (0: as it is written).
Expected<OpenScenario> openScenario(const RunFlags& flags, std::uint32_t trial);

/// A condition of the command line; nullopt where none was given.
Expected<std::optional<Condition>> openCondition(const std::string& text, const Scenario& scenario);

/// What happened, for people and for programs.
std::string statisticsText(const Scenario& scenario, const RunStatistics& statistics);
nlohmann::json statisticsJson(const Scenario& scenario, const RunStatistics& statistics);

std::string hexadecimal(std::uint64_t value);

}  // namespace mrose::cli
