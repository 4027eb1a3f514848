#pragma once

#include <string>
#include <vector>

#include "experiment/experiment_file.h"
#include "io/error.h"
#include "scenario/description_source.h"
#include "scenario/scenario_value.h"
#include "scenario/settings_file.h"

namespace mrose {

/// What a command puts into a scenario beside what its file says: values of settings files, then what it assigns.
struct ScenarioOverrides {
    std::vector<Settings> settings;
    std::vector<std::string> assignments;  ///< "PATH=VALUE", as of parseOverride()

    bool empty() const { return settings.empty() && assignments.empty(); }
};
/// Error: a settings file is not there, or the first thing wrong in it.
Expected<ScenarioOverrides> readOverrides(const std::vector<std::string>& settings,
                                          const std::vector<std::string>& assignments, DescriptionSource& source);

/// With them; settings are seen to fit. Error: what does not fit, of a settings file with its line; no assignment.
Expected<ScenarioValue> withOverrides(ScenarioValue value, const ScenarioOverrides& overrides,
                                      DescriptionSource& source);

/// What was found wrong with a scenario that they were put into: of a file that an assignment names and that was not
/// found, that it was looked for in the current folder, too.
Error soughtHere(Error error, const ScenarioOverrides& overrides);

/// Error: one of them is of something that every run of the experiment has another value of.
Expected<void> checkOverrides(const Experiment& experiment, const ScenarioOverrides& overrides);

/// Whether a variant leaves something of a settings file, or of an assignment, as that says; draws are not looked at.
bool hasEffect(const Settings& settings, const Experiment& experiment, const Variant& variant);
bool hasEffect(const std::string& assignment, const Experiment& experiment, const Variant& variant);
/// Error: one of them has no effect in the variant. A sentence for each place of a settings file that has none.
Expected<std::vector<std::string>> checkOverrides(const Experiment& experiment, const Variant& variant,
                                                  const ScenarioOverrides& overrides);

}  // namespace mrose
