#include "scenario_flags.h"

#include "plugins.h"

namespace mrose::cli {

void addChangeFlags(CLI::App& sub, std::vector<std::string>& settings, std::vector<std::string>& overrides) {
    sub.add_option("--settings", settings,
                   "Puts the values of this file, such as mrose tune makes, into the scenario, before --set")
        ->check(someName())
        ->allow_extra_args(false);
    sub.add_option("--set", overrides,
                   "Overrides something in the scenario: PATH=VALUE, such as robot[2].network=create.net")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
}

void addScenarioFlags(CLI::App& sub, ScenarioRequest& scenario, std::optional<double>& duration, std::string& until) {
    sub.add_option("SCENARIO", scenario.file, "Scenario file, or the name of one that ships: soccer.toml")->required();
    sub.get_option("--seed")->default_str("the scenario's");
    sub.add_option("--duration", duration, "How long to simulate, in s; otherwise what the scenario says")
        ->check(numberRange(0.001, 1e7));
    sub.add_option("--until", until, "Ends a run when this Lua expression over the state holds")
        ->check(
            [](const std::string& text) { return text.empty() ? std::string("is empty; expected a condition") : ""; });
    addChangeFlags(sub, scenario.settings, scenario.overrides);
    sub.add_option("--log", scenario.log, "Read this log instead of those that the scenario names");
    addPluginFlags(sub, scenario.plugins);
}

}  // namespace mrose::cli
