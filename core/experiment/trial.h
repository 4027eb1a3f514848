#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "condition/condition.h"
#include "experiment/experiment_file.h"
#include "experiment/trial_expressions.h"
#include "scenario/description_library.h"
#include "scenario/drawn_values.h"

namespace mrose {

/// How what is wrong in a trial ends: " (trial 5)".
inline std::string inTrial(const std::string& number) { return " (trial " + number + ')'; }

/// One trial of an experiment: what was drawn for it, and the scenario of each variant.
struct Trial {
    DrawnValues drawn;
    std::vector<LoadedScenario> scenarios;
    std::optional<LoadedScenario> before = {};  ///< as it goes until it branches, where it does
    std::optional<Error> fault = {};            ///< why what is drawn for it makes none of them
};

/// Makes the trials of an experiment, each the same whoever makes it and in whatever order. For one thread: it keeps
/// what shapes, networks and expressions were read.
class TrialMaker {
public:
    /// The experiment and its expressions must stay where they are.
    TrialMaker(const Experiment& experiment, TrialExpressions& expressions, ScenarioLoading loading);

    /// `number` counts from 1. Where bodies would overlap in a variant, or what the experiment requires does not hold
    /// in the first, it is drawn anew. Error: a hundred draws were such; what is wrong in the scenario that a draw
    /// makes, or in an expression; a file.
    Expected<Trial> make(std::uint32_t number);
    /// The same, but for what is wrong in this trial alone: that is its fault. Error: what other trials would meet,
    /// too.
    Expected<Trial> makeOrFault(std::uint32_t number);

    /// That the ends and choices of each draw make a scenario, and expressions fit the trials whatever bodies are
    /// there, as far as the start tells. Error: file, line and column of the first thing wrong.
    Expected<void> check();

    /// That expressions fit the scenario of these draws, without a variant. Error: likewise.
    Expected<void> checkExpressions(std::uint32_t number, const DrawnValues& drawn);

private:
    Expected<void> loadBase();
    bool isOfTheTrial(const Error& error, const ScenarioValue& value, const Variant* variant);
    Error told(Error error, const DrawnValues& drawn, const Variant* variant, const std::string& where);
    Expected<DrawnValues> drawnWith(DrawnValues drawn, std::size_t i, const Value& value);
    Expected<void> checkEnds(const DrawnValues& first);
    Expected<DrawnValues> draw(std::uint32_t number, int attempt);
    Expected<Value> valueOf(const Draw& draw, std::uint32_t index, std::uint32_t number, int attempt,
                            const DrawnValues& drawn);
    /// With all bodies, also those that are to be left out.
    Expected<ScenarioValue> drawnScenario(std::uint32_t number, const DrawnValues& drawn) const;
    ScenarioValue withoutBodies(ScenarioValue value, const DrawnValues& drawn) const;
    /// nullopt: bodies overlap.
    Expected<std::optional<LoadedScenario>> scenarioOf(const ScenarioValue& value);
    Expected<bool> isWanted(const LoadedScenario& loaded, const DrawnValues& drawn);

    const Experiment& experiment_;
    TrialExpressions& expressions_;
    ScenarioLoading loading_;
    NoDescriptions none_;
    DescriptionLibrary library_{none_};
    std::optional<Scenario> base_;  ///< as written: what computed draws may ask
    std::vector<std::optional<WorldValue>> computed_;
};

}  // namespace mrose
