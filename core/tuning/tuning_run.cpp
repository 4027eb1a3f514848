#include "tuning/tuning_run.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>

#include "experiment/experiment_row.h"
#include "experiment/trial_run.h"
#include "io/format.h"
#include "io/shell_quoted.h"
#include "io/toml_text.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

// Of those held out, in which it is counted how unfamiliar the driving is.
constexpr std::uint32_t watchedTrials = 40;

std::string candidateName(std::size_t candidate) { return "candidate " + std::to_string(candidate + 1); }

/// Runs of candidates, on any thread.
class CandidateRuns {
public:
    CandidateRuns(const Tuning& tuning, const TuningOptions& options, ResultsFile& file)
        : tuning_(tuning),
          options_(options),
          file_(file),
          experiment_(tuning.experiment),
          named_(tuning.experiment),
          places_(experiment_, options.loading) {
        named_.variants.clear();
    }

    /// As of TrialCosts.
    Expected<std::vector<double>> costs(std::size_t candidate, const std::vector<double>& values, std::uint32_t first,
                                        std::uint32_t count) {
        begin(candidate, values);
        std::vector<std::uint32_t> missing;
        for (std::uint32_t trial = first; trial < first + count; ++trial)
            if (!isDone(trial)) missing.push_back(trial);
        parallelFor(missing.size(), [&](std::size_t i) {
            if (stop_) return;
            auto place = places_.take();
            runTrial(*place, missing[i]);
            places_.giveBack(std::move(place));
        });
        if (error_) return tl::unexpected(*error_);
        if (stop_) return std::vector<double>();
        std::vector<double> all;
        for (std::uint32_t trial = first; trial < first + count; ++trial) {
            const auto cost = costOf(trial);
            if (!cost) return tl::unexpected(cost.error());
            all.push_back(*cost);
        }
        progress(count - static_cast<std::int64_t>(missing.size()));
        return all;
    }

    /// For how much of the time some robot is driven as its network has not learned, in trials each with their first
    /// seed. nullopt: no network says; of what was stopped() it is of no use.
    Expected<std::optional<double>> unfamiliarShare(std::size_t candidate, const std::vector<double>& values,
                                                    std::uint32_t first, std::uint32_t count) {
        begin(candidate, values);
        std::int64_t ticks = 0, unfamiliar = 0;
        bool known = false;
        parallelFor(count, [&](std::size_t i) {
            if (stop_) return;
            auto place = places_.take();
            const auto number = first + static_cast<std::uint32_t>(i);
            const auto trial = scenarioOf(*place, number);
            if (!trial) return;
            const RunKey key = keyOf(number, 0);
            if (options_.begins) options_.begins(key);
            const auto measured = measuredRun(
                experiment_, place->expressions, trial->scenario, trial->drawn, key.seed, [this] { return goesOn(); },
                true);
            if (!measured) return fail(measured.error());
            places_.giveBack(std::move(place));
            const RunStatistics& statistics = measured->result.statistics;
            const std::lock_guard lock(mutex_);
            ticks += statistics.ticks;
            unfamiliar += statistics.anyUnfamiliar;
            known = known || std::ranges::any_of(statistics.unfamiliar, [](const auto& of) { return of.has_value(); });
        });
        if (error_) return tl::unexpected(*error_);
        if (!known) return std::nullopt;
        return ticks > 0 ? static_cast<double>(unfamiliar) / static_cast<double>(ticks) : 0;
    }

    void best(double cost) { best_ = cost; }
    bool stopped() const { return stop_; }

private:
    struct DrawnScenario {
        Scenario scenario;
        DrawnValues drawn;
    };
    /// nullopt: it does not fit, which ends all.
    std::optional<DrawnScenario> scenarioOf(Workplace& place, std::uint32_t number) {
        auto trial = place.maker.make(number);
        if (!trial) {
            Error error = trial.error();
            error.cause += ", with" + changes_;
            fail(error);
            return std::nullopt;
        }
        ScenarioParts& parts = trial->scenarios.front().parts;
        if (options_.loaded) options_.loaded(parts);
        return DrawnScenario{Scenario(std::move(parts)), std::move(trial->drawn)};
    }
    bool goesOn() {
        if (!stop_ && options_.goesOn && !options_.goesOn()) stop_ = true;
        return !stop_;
    }

    void begin(std::size_t candidate, const std::vector<double>& values) {
        number_ = static_cast<std::uint32_t>(candidate) + 1;
        if (named_.variants.size() < number_) named_.variants.resize(number_);
        named_.variants[candidate].name = candidateName(candidate);
        Variant& variant = experiment_.variants.front();
        variant = tuning_.experiment.variants.front();
        changes_.clear();
        for (const auto& [path, value] : generalFirst(tunedSets(tuning_.options.parameters, values))) {
            variant.set.emplace_back(path, value);
            const std::int64_t* const whole = value.asInteger();
            changes_ +=
                " --set " +
                shellQuoted(path + '=' + (whole != nullptr ? std::to_string(*whole) : numberText(*value.asFloat())));
        }
    }

    RunKey keyOf(std::uint32_t trial, std::uint32_t k) const {
        return {trial, experiment_.noiseSeed(trial, k), number_};
    }
    bool isDone(std::uint32_t trial) const {
        for (std::uint32_t k = 0; k < experiment_.seeds; ++k)
            if (!file_.has(keyOf(trial, k))) return false;
        return true;
    }

    void runTrial(Workplace& place, std::uint32_t number) {
        const auto trial = scenarioOf(place, number);
        if (!trial) return;
        for (std::uint32_t k = 0; k < experiment_.seeds && !stop_; ++k) {
            const RunKey key = keyOf(number, k);
            {
                const std::lock_guard lock(mutex_);
                if (file_.has(key)) continue;
            }
            if (options_.begins) options_.begins(key);
            const auto measured = measuredRun(experiment_, place.expressions, trial->scenario, trial->drawn, key.seed,
                                              [this] { return goesOn(); });
            if (!measured) return fail(measured.error());
            const std::lock_guard lock(mutex_);
            if (stop_) return;
            if (const auto kept = file_.add(key, rowOf(key, trial->drawn, *measured, trial->scenario)); !kept)
                return failNow(kept.error());
        }
        progress(1);
    }

    std::string rowOf(const RunKey& key, const DrawnValues& drawn, const MeasuredRun& measured,
                      const Scenario& scenario) const {
        std::string flags = changes_ + " --trial " + std::to_string(key.trial) + " --seed " + std::to_string(key.seed);
        if (const std::string& variant = tuning_.experiment.variants.front().name; !variant.empty())
            flags += " --variant " + shellQuoted(variant);
        return experimentRow(named_, key, drawn, measured.measurement, measured.result, scenario.scene().tickLength,
                             {options_.command + flags, options_.window + flags});
    }

    /// The mean of a trial's seeds.
    Expected<double> costOf(std::uint32_t trial) const {
        double sum = 0;
        for (std::uint32_t k = 0; k < experiment_.seeds; ++k) {
            const RowOutcome outcome = rowOutcome(experiment_, file_.rows().at(keyOf(trial, k)));
            double cost = 0;
            for (const CostTerm& term : tuning_.cost) cost += term.weight * outcome.measures[term.measure];
            const bool failed = outcome.faulty || !std::isfinite(cost);
            if (failed && !tuning_.failureCost)
                return tl::unexpected(Error{
                    tuning_.file, static_cast<int>(tuning_.costLine), static_cast<int>(tuning_.costColumn), "cost",
                    std::string(outcome.faulty ? "a fault ended" : "is no number in") + " trial " +
                        std::to_string(trial) + " of candidate " + std::to_string(number_) +
                        (outcome.faulty ? " (" + outcome.fault + ')' : "") +
                        "; expected `failure_cost`, what such a run costs"});
            sum += failed ? *tuning_.failureCost : cost;
        }
        return sum / experiment_.seeds;
    }

    void progress(std::int64_t more) {
        const std::lock_guard lock(progressMutex_);
        done_ += more;
        if (options_.progress && more > 0) options_.progress(done_, all(), best_);
    }
    std::int64_t all() const { return tuning_.options.evaluations + 2 * std::int64_t{tuning_.options.heldOut}; }

    void fail(const Error& error) {
        const std::lock_guard lock(mutex_);
        failNow(error);
    }
    void failNow(const Error& error) {
        if (!error_) error_ = error;
        stop_ = true;
    }

    const Tuning& tuning_;
    const TuningOptions& options_;
    ResultsFile& file_;
    Experiment experiment_;  ///< its variant is the candidate that is run
    Experiment named_;       ///< its variants are all candidates, by name
    Workplaces places_;
    std::uint32_t number_ = 0;  ///< of the candidate that is run, from 1
    std::string changes_;       ///< its values, as flags
    std::mutex mutex_, progressMutex_;
    std::atomic<bool> stop_{false};
    std::optional<Error> error_;
    std::int64_t done_ = 0;
    double best_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

std::string UnfamiliarDriving::note() const {
    if (tuned < RunStatistics::notableShare) return "";
    return "Tuned, in " + fixed(100 * tuned, 0) + " % of the time some robot is driven as its network has not " +
           "learned (before in " + fixed(100 * before, 0) + " %).";
}

Expected<TuningSummary> runTuning(const Tuning& tuning, const TuningOptions& options,
                                  const std::filesystem::path& folder) {
    {
        TrialExpressions expressions(tuning.experiment);
        TrialMaker maker(tuning.experiment, expressions, options.loading);
        if (const auto fits = maker.check(); !fits) return tl::unexpected(fits.error());
    }
    auto file = ResultsFile::open(folder, options.identity, experimentHeader(tuning.experiment));
    if (!file) return tl::unexpected(file.error());
    const auto searched = [&](const RunKey& key) { return key.trial <= tuning.options.trials; };
    std::int64_t before = 0;
    for (const auto& [key, row] : file->rows()) before += searched(key) ? 1 : 0;
    if (before > tuning.options.evaluations * tuning.experiment.seeds)
        return fail(folder.string(),
                    "holds more evaluations than are asked for now; expected another folder, or more "
                    "`evaluations`");
    TuningSummary summary;
    summary.resumed = static_cast<std::int64_t>(file->rows().size());
    CandidateRuns runs(tuning, options, *file);
    auto result = tune(
        tuning.options,
        [&](std::size_t candidate, const std::vector<double>& values, std::uint32_t first, std::uint32_t count) {
            return runs.costs(candidate, values, first, count);
        },
        [&](std::int64_t, double best) { runs.best(best); });
    if (!result) return tl::unexpected(result.error());
    summary.result = std::move(*result);
    summary.runs = static_cast<std::int64_t>(file->rows().size());
    if (!summary.result.complete) return summary;
    const auto shareOf = [&](std::size_t candidate) {
        return runs.unfamiliarShare(candidate, summary.result.candidates[candidate].values, tuning.options.trials + 1,
                                    std::min(tuning.options.heldOut, watchedTrials));
    };
    const auto now = shareOf(0);
    if (!now) return tl::unexpected(now.error());
    const auto tuned = *now && summary.result.best != 0 ? shareOf(summary.result.best) : now;
    if (!tuned) return tl::unexpected(tuned.error());
    if (runs.stopped()) {
        summary.result.complete = false;
        return summary;
    }
    if (*now && *tuned) summary.unfamiliar = {**now, **tuned};
    if (const auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
    return summary;
}

}  // namespace mrose
