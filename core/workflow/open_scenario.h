#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiment/branching.h"
#include "experiment/experiment_file.h"
#include "scenario/drawn_values.h"
#include "workflow/overrides.h"
#include "workflow/plugins.h"

namespace mrose {

/// A scenario that is to be run, and what is other than its file says.
struct ScenarioRequest {
    std::string file;                         ///< or the name of one that ships
    std::string log = {};                     ///< read instead of those that it names
    std::vector<std::string> overrides = {};  ///< "PATH=VALUE", as of parseOverride()
    /// Starts as this trial of a batch does; 0: as it is written. Of an experiment, whose file may stand for its
    /// scenario: this trial; 0: the first.
    std::uint32_t trial = 0;
    std::string variant = {};  ///< of an experiment; empty: the first
    PluginUse plugins = {};
    std::vector<std::string> settings = {};  ///< files whose values are put into the scenario before `overrides`
};

/// What an experiment says of one of its trials beside the scenario.
struct OpenedTrial {
    std::shared_ptr<const Experiment> experiment;
    std::uint32_t number = 0;
    std::string variant;
    DrawnValues drawn;
    /// Where it parts from the other variants; null: it is none of an experiment that branches. Of one that does not
    /// reach it the scenario is as it is until then, without a variant, and lasts as long as that is waited for.
    std::shared_ptr<const BranchPoint> branch = {};
};

/// A scenario ready to run.
struct OpenedScenario {
    LoadedScenario loaded;
    std::map<std::string, std::string> plugins;  ///< hashes of their files' contents, by path
    std::shared_ptr<const Scenario> scenario;
    std::vector<std::string> notes;         ///< what is most likely a mistake or must be known, a sentence each
    std::optional<OpenedTrial> trial = {};  ///< of an experiment

    /// As it begins, with a seed or its own. A trial that does not branch always has that of its first run.
    WorldState initialState(std::optional<std::uint64_t> seed) const;
};

/// Error: the first thing wrong in any file that it is made from, or in an override.
Expected<OpenedScenario> openScenario(const ScenarioRequest& request);
/// The same of descriptions from elsewhere than the disk, instead of `request.log` too.
Expected<OpenedScenario> openScenario(const ScenarioRequest& request, DescriptionSource& source);

/// An experiment, with what is overridden in its scenario; a validation is one, too.
struct OpenedExperiment {
    Experiment experiment;
    Value content;  ///< of its file
    ScenarioOverrides overrides = {};
};
/// nullopt: `file` describes something else, or there is none. Error: the first thing wrong in it.
Expected<std::optional<OpenedExperiment>> openExperiment(const std::string& file,
                                                         const std::vector<std::string>& overrides,
                                                         DescriptionSource& source,
                                                         const std::vector<std::string>& settings = {});

/// A sentence for each body that starts outside the walls, of the first ten: most are a mistake.
std::vector<std::string> startsOutsideText(const Scene& scene);

}  // namespace mrose
