#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/experiment_file.h"
#include "io/error.h"
#include "io/value.h"
#include "scenario/description_source.h"
#include "scenario/scenario_file.h"
#include "tuning/tuner.h"

namespace mrose {

/// What a run costs: a sum of measures, each by a weight.
struct CostTerm {
    std::size_t measure = 0;  ///< of the experiment's
    double weight = 1;
};

/// A search for a controller's parameters in the trials of an experiment (resources/experiments/README.md).
struct Tuning {
    std::string file, name;
    /// What the file and its experiment are called wherever they lie: of those that ship, the name alone.
    std::string called, experimentCalled;
    Experiment experiment;  ///< with the variant that is tuned, and no other
    Value content;          ///< of the file
    Value::File experimentFile;
    TunerOptions options;
    std::vector<CostTerm> cost;
    std::string costText;               ///< for people: "time_s + 10 held_s"
    std::optional<double> failureCost;  ///< of a run that ends by a fault, or has no number
    std::uint32_t costLine = 0, costColumn = 0;
};

/// As it stands in a scenario: of whole numbers an integer.
Value parameterValue(const TunedParameter& parameter, double value);
/// What parameters of these values set in the scenario, by path.
Value::Table tunedSets(const std::vector<TunedParameter>& parameters, const std::vector<double>& values);

/// Error: file, line, column and key of the first thing wrong, in the experiment too.
Expected<Tuning> readTuning(const Value::File& file, DescriptionSource& source, const ScenarioLoading& loading = {});
/// Whether a description is one.
bool isTuning(const Value& content);

}  // namespace mrose
