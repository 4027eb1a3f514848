#include "validation/validation_results.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "experiment/possible_values.h"
#include "experiment/run.h"
#include "io/format.h"
#include "motion/motion_network.h"

namespace mrose {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr double secondsAnHour = 3600;

/// The rows of a trial with one seed, by the cells' places.
struct PairedRun {
    std::array<std::optional<std::size_t>, validationCells> row{};
};
using PairedRuns = std::map<std::pair<std::uint32_t, std::uint64_t>, PairedRun>;

template <class Number>
Number wholeOf(const std::string& cell) {
    Number number = 0;
    std::from_chars(cell.data(), cell.data() + cell.size(), number);
    return number;
}

tl::unexpected<Error> notYesNo(const Validation& validation, const ValidatedMeasure& measure, double value,
                               std::uint32_t trial) {
    return tl::unexpected(Error{validation.file, static_cast<int>(measure.line), static_cast<int>(measure.column),
                                "measure[\"" + measure.name + "\"]",
                                "is " + numberText(value) + " in trial " + std::to_string(trial) +
                                    "; expected 1 or 0 of a measure of yes and no"});
}

class ResultReader {
public:
    ResultReader(const Validation& validation, const ResultsTable& table) : validation_(validation), table_(table) {}

    Expected<ValidationResult> read() {
        if (auto fits = findColumns(); !fits) return tl::unexpected(fits.error());
        collectRuns();
        for (std::size_t i = 0; i < validation_.measures.size(); ++i) {
            auto measured = measureOf(i);
            if (!measured) return tl::unexpected(measured.error());
            result_.measures.push_back(std::move(*measured));
        }
        findDisagreements();
        account();
        return std::move(result_);
    }

private:
    Expected<void> findColumns() {
        for (const char* const name : {"variant", "end", "time_s"})
            if (table_.columnOf(name) == table_.columns.size())
                return fail(table_.file, std::string("has no column ") + name + "; expected an experiment's", 1);
        variant_ = table_.columnOf("variant"), end_ = table_.columnOf("end"), time_ = table_.columnOf("time_s");
        for (const ValidatedMeasure& measure : validation_.measures) {
            columns_.push_back(table_.columnOf("measure." + measure.name));
            if (columns_.back() == table_.columns.size())
                return fail(table_.file, "has no column measure." + measure.name, 1);
        }
        return {};
    }

    void collectRuns() {
        for (const bool real : {false, true})
            for (const bool after : {false, true}) {
                const ValidationCell cell{after, real};
                CellRuns& runs = result_.cells[cell.place()];
                runs.name = validation_.nameOf(cell);
                runs.measured = real && validation_.real.has_value();
                if (runs.measured) runs.runs = static_cast<std::int64_t>(validation_.real->size());
            }
        for (std::size_t row = 0; row < table_.rows.size(); ++row) {
            const std::vector<std::string>& cells = table_.rows[row];
            const auto place = wholeOf<std::size_t>(cells[variant_]) - 1;
            if (place >= validation_.experiment.variants.size()) continue;
            CellRuns& runs = result_.cells[place];
            ++runs.runs;
            runs.unfinished += cells[end_] == name(RunEnd::duration) ? 1 : 0;
            runs.faulty += isFaulty(row) ? 1 : 0;
            runs.hours += table_.number(row, time_) / secondsAnHour;
            runs_[{wholeOf<std::uint32_t>(cells[0]), wholeOf<std::uint64_t>(cells[1])}].row[place] = row;
        }
    }

    /// A run's number; NaN: it is not known, a fault ended the run, or there is no such run.
    double valueOf(const PairedRun& run, std::size_t place, std::size_t measure) const {
        if (!run.row[place] || isFaulty(*run.row[place])) return missing;
        const double value = table_.number(*run.row[place], columns_[measure]);
        return std::isfinite(value) ? value : missing;
    }
    bool isFaulty(std::size_t row) const { return table_.rows[row][end_] == name(RunEnd::fault); }
    bool isRun(std::size_t place) const { return place < validation_.experiment.variants.size(); }

    double realValue(std::uint32_t trial, bool after, std::size_t measure) const {
        const auto found = validation_.real->find(trial);
        return found == validation_.real->end() ? missing : found->second[after ? 1 : 0][measure];
    }

    Expected<MeasureValidation> measureOf(std::size_t index) {
        MeasureValidation of{.measure = validation_.measures[index]};
        struct Sum {
            std::array<double, validationCells> of{};
            double seeds = 0;
        };
        std::map<std::uint32_t, Sum> sums;
        double runs = 0;
        for (const auto& [key, run] : runs_) {
            Sum& sum = sums[key.first];
            std::array<double, validationCells> values{};
            for (std::size_t place = 0; place < validationCells; ++place)
                values[place] = isRun(place) ? valueOf(run, place, index) : realValue(key.first, place == 3, index);
            if (std::ranges::any_of(values, [](double value) { return std::isnan(value); })) continue;
            for (std::size_t place = 0; place < validationCells; ++place) {
                const double value = values[place];
                const bool share = isRun(place) ? value == 0 || value == 1 : value >= 0 && value <= 1;
                if (of.measure.yesNo && !share) return notYesNo(validation_, of.measure, value, key.first);
                sum.of[place] += value;
            }
            sum.seeds += 1, runs += 1;
        }
        for (const auto& [trial, sum] : sums) {
            if (sum.seeds == 0) {
                ++of.leftOut;
                continue;
            }
            TrialValues& values = of.trials.emplace_back(TrialValues{trial});
            for (std::size_t place = 0; place < validationCells; ++place) values.of[place] = sum.of[place] / sum.seeds;
        }
        summarise(of, runs);
        return of;
    }

    ValueRange possibleOf(const ValidatedMeasure& measure) const {
        if (measure.yesNo) return {0, 1};
        return possibleValues(*std::ranges::find(validation_.experiment.measures, measure.name, &Measure::name));
    }

    void summarise(MeasureValidation& of, double runs) const {
        const ValueRange possible = possibleOf(of.measure), differences = possibleDifferences(possible);
        const auto column = [&](auto value) {
            std::vector<double> numbers;
            for (const TrialValues& trial : of.trials) numbers.push_back(value(trial));
            return numbers;
        };
        for (std::size_t place = 0; place < validationCells; ++place) {
            const std::vector<double> values = column([&](const TrialValues& trial) { return trial.of[place]; });
            of.cells[place] = limited(meanOf(values), possible);
            if (of.measure.yesNo) of.cells[place] = wilsonShare(of.cells[place].value, effectiveCount(values, runs));
        }
        const auto gains = [&](bool real) {
            return column([&](const TrialValues& trial) { return trial.gain(of.measure, real); });
        };
        const std::vector<double> simulated = gains(false), real = gains(true);
        of.gain = {limited(meanOf(simulated), differences), limited(meanOf(real), differences)};
        if (of.gain[0].value > 0) of.survives = ratioOfMeans(real, simulated);
        for (const std::size_t after : {0u, 1u})
            of.worse[after] = limited(meanOf(column([&](const TrialValues& trial) {
                                          return of.measure.gain(trial.of[2 + after], trial.of[after]);
                                      })),
                                      differences);
    }

    void findDisagreements() {
        std::vector<Disagreement> all;
        for (const auto& [key, run] : runs_)
            for (const bool after : {false, true}) {
                const std::size_t simulated = ValidationCell{after, false}.place();
                const std::size_t real = ValidationCell{after, true}.place();
                Disagreement one{key.first, key.second, after, valueOf(run, simulated, 0)};
                one.real = isRun(real) ? valueOf(run, real, 0) : realValue(key.first, after, 0);
                if (std::isnan(one.simulated) || std::isnan(one.real)) continue;
                one.simulatedRow = *run.row[simulated];
                if (isRun(real)) one.realRow = run.row[real];
                all.push_back(one);
            }
        std::ranges::stable_sort(
            all, [](const Disagreement& a, const Disagreement& b) { return a.difference() > b.difference(); });
        std::set<std::uint32_t> taken;
        for (const Disagreement& one : all)
            if (result_.disagreements.size() < shownDisagreements && one.difference() > 0 &&
                taken.insert(one.trial).second)
                result_.disagreements.push_back(one);
    }

    void account() {
        AccountResult& account = result_.account;
        const ValidationAccount& given = validation_.account;
        account.logMinutes = given.logMinutes;
        if (!account.logMinutes) {
            // A pattern is a control period.
            double seconds = 0;
            for (const Value::File& file : validation_.experiment.scenario.files()) {
                const std::string* const text = file->content.asText();
                if (text == nullptr) continue;
                const auto network = parseNetwork(*text, file->name);
                if (!network) continue;
                seconds += static_cast<double>(network->training.patterns) * toSeconds(network->period);
                account.fromNetworks = true;
            }
            if (account.fromNetworks) account.logMinutes = seconds / 60;
        }
        account.simulatedHours = given.simulatedHours;
        for (const std::size_t place : {0u, 1u}) {
            account.simulatedRuns += result_.cells[place].runs;
            account.simulatedHours += result_.cells[place].hours;
        }
        account.resetHours = given.resetSeconds * static_cast<double>(account.simulatedRuns) / secondsAnHour;
        account.computingMinutes = given.computingMinutes;
    }

    const Validation& validation_;
    const ResultsTable& table_;
    ValidationResult result_;
    std::size_t variant_ = 0, end_ = 0, time_ = 0;
    std::vector<std::size_t> columns_;  ///< of the measures
    PairedRuns runs_;
};

std::string cellsOf(const Estimate& estimate) {
    std::string text;
    for (const double number : {estimate.value, estimate.low, estimate.high})
        text += std::isfinite(number) ? ',' + numberText(number) : ",nan";
    return text;
}

}  // namespace

Expected<void> checkOutcome(const Validation& validation, const RunKey& key, const RowOutcome& outcome) {
    const std::vector<Measure>& all = validation.experiment.measures;
    for (const ValidatedMeasure& measure : validation.measures) {
        const auto place = std::ranges::find(all, measure.name, &Measure::name) - all.begin();
        const double value = outcome.measures[static_cast<std::size_t>(place)];
        if (measure.yesNo && !outcome.faulty && std::isfinite(value) && value != 0 && value != 1)
            return notYesNo(validation, measure, value, key.trial);
    }
    return {};
}

Expected<ValidationResult> validationResult(const Validation& validation, const ResultsTable& results) {
    return ResultReader(validation, results).read();
}

std::string validationCsv(const ValidationResult& result, const Validation& validation) {
    std::string text = "measure,what,value,low,high,trials\n";
    for (const MeasureValidation& of : result.measures) {
        const auto line = [&](const std::string& what, const Estimate& estimate) {
            text += csvCell(of.measure.name) + ',' + csvCell(what) + cellsOf(estimate) + ',' +
                    std::to_string(of.trials.size()) + '\n';
        };
        for (std::size_t place = 0; place < validationCells; ++place) line(result.cells[place].name, of.cells[place]);
        line("gain in " + validation.simulation, of.gain[0]);
        line("gain in " + validation.reality, of.gain[1]);
        line("share of the gain that survives", of.survives);
        line(validation.before + ": worse in " + validation.reality, of.worse[0]);
        line(validation.after + ": worse in " + validation.reality, of.worse[1]);
    }
    return text;
}

std::string disagreementsCsv(const ValidationResult& result, const ResultsTable& results) {
    const auto line = [](const std::vector<std::string>& cells) {
        std::string text;
        for (const std::string& cell : cells) text += (text.empty() ? "" : ",") + csvCell(cell);
        return text + '\n';
    };
    std::string text = line(results.columns);
    for (const Disagreement& one : result.disagreements) {
        text += line(results.rows[one.simulatedRow]);
        if (one.realRow) text += line(results.rows[*one.realRow]);
    }
    return text;
}

}  // namespace mrose
