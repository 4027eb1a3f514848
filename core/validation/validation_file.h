#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiment/experiment_file.h"
#include "io/error.h"
#include "io/value.h"
#include "scenario/description_source.h"
#include "scenario/scenario_file.h"
#include "validation/real_results.h"

namespace mrose {

/// What is compared: controllers, before and after they learned, in the simulator and in the reality.
struct ValidationCell {
    bool after = false, real = false;
    /// Its place among four in this order: before and after in the simulator, then in the reality.
    std::size_t place() const { return (real ? 2u : 0u) + (after ? 1u : 0u); }
};
constexpr std::size_t validationCells = 4;

/// A measure of the experiment by which the cells are compared.
struct ValidatedMeasure {
    std::string name, unit;
    bool lessIsBetter = true;
    bool yesNo = false;                  ///< 1 or 0 in each run: shares and percentage points
    std::uint32_t line = 0, column = 0;  ///< where `yes_no` stands, else the name
    /// Of how much `after` is better than `before`.
    double gain(double before, double after) const { return lessIsBetter ? before - after : after - before; }
};

/// What learning and tuning took, beside what the runs show.
struct ValidationAccount {
    std::optional<double> logMinutes;  ///< of the logs that the simulator was learned from
    double simulatedHours = 0;         ///< that learning and tuning took
    double computingMinutes = 0;       ///< likewise
    double resetSeconds = 0;           ///< a person needs between two trials with real robots
};

/// Trials by their numbers, both ends among them.
struct TrialRange {
    std::uint32_t first = 0, last = 0;
};

/// `format = "mrose validation"` (resources/experiments/README.md): an experiment of up to four variants.
struct Validation {
    std::string file, name;
    std::string before, after, simulation, reality;  ///< what people call them
    Experiment experiment;                           ///< its variants are the cells that are run, by their places
    Value content;                                   ///< of that experiment's file, as if it stood in one
    std::vector<ValidatedMeasure> measures;          ///< the first is the main one
    std::optional<RealResults> real;                 ///< what was measured in reality; nullopt: it is run
    ValidationAccount account;
    std::vector<std::string> notes;  ///< what a reader must know: which trials are not known to be unused

    std::string nameOf(const ValidationCell& cell) const;
};

/// Error: file, line, column and key of the first thing wrong, in the experiment too; trials that learning or tuning
/// used are among those that are asked for.
Expected<Validation> readValidation(const Value::File& file, DescriptionSource& source,
                                    const ScenarioLoading& loading = {});
/// Whether a description is one.
bool isValidation(const Value& content);

}  // namespace mrose
