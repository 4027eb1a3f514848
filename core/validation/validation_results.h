#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "experiment/estimates.h"
#include "experiment/experiment.h"
#include "experiment/results_table.h"
#include "io/error.h"
#include "validation/validation_file.h"

namespace mrose {

/// The runs of a cell.
struct CellRuns {
    std::string name;
    bool measured = false;  ///< in reality, by a CSV: of its runs nothing more is known
    std::int64_t runs = 0;
    std::int64_t unfinished = 0;  ///< not ended by `until`
    std::int64_t faulty = 0;      ///< ended by a fault: of no measure they have a number
    double hours = 0;             ///< simulated
};

/// A trial's four numbers, by the cells' places: the mean over its seeds.
struct TrialValues {
    std::uint32_t trial = 0;
    std::array<double, validationCells> of{};
    double gain(const ValidatedMeasure& measure, bool real) const {
        return real ? measure.gain(of[2], of[3]) : measure.gain(of[0], of[1]);
    }
};

/// What a measure says. Gains are positive where `after` is better.
struct MeasureValidation {
    ValidatedMeasure measure;
    std::vector<TrialValues> trials;                ///< those with a number in every cell
    std::size_t leftOut = 0;                        ///< trials without
    std::array<Estimate, validationCells> cells{};  ///< means over trials; of yes and no shares, by Wilson's interval
    std::array<Estimate, 2> gain{};                 ///< in the simulator, in the reality: paired by trial
    Estimate survives;                              ///< gain in the reality over gain in the simulator
    std::array<Estimate, 2> worse{};                ///< before, after: by how much it is worse in the reality
};

/// A run whose main measure differs most between simulator and reality.
struct Disagreement {
    std::uint32_t trial = 0;
    std::uint64_t seed = 0;  ///< 0: the mean of all, beside a CSV
    bool after = false;
    double simulated = 0, real = 0;
    std::size_t simulatedRow = 0;          ///< in the results
    std::optional<std::size_t> realRow{};  ///< likewise, where it was run
    double difference() const { return simulated < real ? real - simulated : simulated - real; }
};

/// Hours of real robots, with and without the simulator.
struct AccountResult {
    std::optional<double> logMinutes;  ///< that it was learned from
    bool fromNetworks = false;         ///< as the motion networks say how many patterns they were learned from
    std::int64_t simulatedRuns = 0;
    double simulatedHours = 0;    ///< of these runs, and by learning and tuning
    double resetHours = 0;        ///< that people would need between them
    double computingMinutes = 0;  ///< by learning and tuning
    /// What the simulated runs would have taken real robots, less what the logs took; 0 where that is more.
    double sparedHours() const { return std::max(0.0, simulatedHours + resetHours - logMinutes.value_or(0) / 60); }
};

struct ValidationResult {
    std::array<CellRuns, validationCells> cells{};
    std::vector<MeasureValidation> measures;
    std::vector<Disagreement> disagreements;  ///< of the first measure, of as many trials, the largest first
    AccountResult account;
};

constexpr std::size_t shownDisagreements = 12;

/// Of a run as soon as it is over. Error: a measure of yes and no is another number than 0 and 1.
Expected<void> checkOutcome(const Validation& validation, const RunKey& key, const RowOutcome& outcome);

/// Error: the table has not the cells' rows, or a measure of yes and no another number than 0 and 1.
Expected<ValidationResult> validationResult(const Validation& validation, const ResultsTable& results);

/// One line for each measure and cell, gain and share.
std::string validationCsv(const ValidationResult& result, const Validation& validation);
/// The rows of results.csv at which simulator and reality disagree most, as such a file.
std::string disagreementsCsv(const ValidationResult& result, const ResultsTable& results);

}  // namespace mrose
