#include "experiment/experiment.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include "experiment/batch.h"
#include "experiment/branching.h"
#include "experiment/experiment_row.h"
#include "experiment/trial_run.h"
#include "io/shell_quoted.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

class ExperimentRunner {
public:
    ExperimentRunner(const Experiment& experiment, const ExperimentOptions& options, ResultsFile& file)
        : experiment_(experiment),
          options_(options),
          file_(file),
          places_(experiment, options.loading),
          runs_(static_cast<std::int64_t>(experiment.trials) * experiment.seeds * std::ssize(experiment.variants)) {}

    Expected<ExperimentSummary> runAll() {
        std::vector<std::uint32_t> missing;
        for (std::uint32_t trial = experiment_.firstTrial; trial - experiment_.firstTrial < experiment_.trials; ++trial)
            if (isMissing(trial)) missing.push_back(trial);
        done_ = static_cast<std::int64_t>(file_.rows().size());
        ExperimentSummary summary{.runs = runs_, .resumed = done_};
        parallelFor(missing.size(), [&](std::size_t i) {
            if (stop_) return;
            auto place = places_.take();
            runTrial(*place, missing[i]);
            places_.giveBack(std::move(place));
        });
        if (error_) return tl::unexpected(*error_);
        summary.done = done_;
        summary.complete = done_ == runs_;
        summary.variants = summarised(experiment_, file_.rows());
        summary.until = !experiment_.until.empty();
        if (summary.complete)
            if (const auto finished = file_.finish(); !finished) return tl::unexpected(finished.error());
        return summary;
    }

private:
    RunKey keyOf(std::uint32_t trial, std::size_t variant, std::uint32_t k) const {
        return {trial, experiment_.noiseSeed(trial, k), static_cast<std::uint32_t>(variant) + 1};
    }
    bool isMissing(std::uint32_t trial) const {
        for (std::size_t variant = 0; variant < experiment_.variants.size(); ++variant)
            for (std::uint32_t k = 0; k < experiment_.seeds; ++k)
                if (!file_.has(keyOf(trial, variant, k))) return true;
        return false;
    }

    void runTrial(Workplace& place, std::uint32_t number) {
        auto trial = place.maker.makeOrFault(number);
        if (!trial) return fail(trial.error());
        if (trial->fault) return keepFaults(number, *trial->fault);
        std::optional<BranchPoint> point;
        if (trial->before) {
            if (options_.loaded) options_.loaded(trial->before->parts);
            auto come = runToBranch(experiment_, place.expressions, std::move(trial->before->parts), trial->drawn,
                                    [this] { return goesOn(); });
            if (!come) return keepFaults(number, come.error());
            if (come->before.end == RunEnd::stopped) {
                stop_ = true;
                return;
            }
            point.emplace(std::move(*come));
        }
        for (std::size_t variant = 0; variant < experiment_.variants.size(); ++variant) {
            ScenarioParts& parts = trial->scenarios[variant].parts;
            if (options_.loaded) options_.loaded(parts);
            const Scenario scenario(std::move(parts));
            for (std::uint32_t k = 0; k < experiment_.seeds && !stop_; ++k) {
                const RunKey key = keyOf(number, variant, k);
                {
                    const std::lock_guard lock(mutex_);
                    if (file_.has(key)) continue;
                }
                if (options_.begins) options_.begins(key);
                const auto row =
                    point ? rowOf(place, *point, scenario, key) : rowOf(place, scenario, trial->drawn, key);
                keep(key, row);
            }
        }
    }

    void keep(const RunKey& key, const std::string& row) {
        const std::lock_guard lock(mutex_);
        if (stop_ || file_.has(key)) return;
        if (options_.fits)
            if (const auto fits = options_.fits(key, rowOutcome(experiment_, row)); !fits) return failNow(fits.error());
        if (const auto kept = file_.add(key, row); !kept) return failNow(kept.error());
        ++done_;
        if (options_.progress) options_.progress(done_, runs_);
    }
    /// Of a trial of which no run can be begun.
    void keepFaults(std::uint32_t number, const Error& error) {
        for (std::size_t variant = 0; variant < experiment_.variants.size(); ++variant)
            for (std::uint32_t k = 0; k < experiment_.seeds; ++k) {
                const RunKey key = keyOf(number, variant, k);
                keep(key, faultyRow(experiment_, key, error, commandsOf(key)));
            }
    }

    bool goesOn() const { return !stop_ && (!options_.goesOn || options_.goesOn()); }

    std::string rowOf(Workplace& place, const Scenario& scenario, const DrawnValues& drawn, const RunKey& key) {
        const auto measured =
            measuredRun(experiment_, place.expressions, scenario, drawn, key.seed, [this] { return goesOn(); });
        return rowOf(measured, scenario, drawn, key);
    }
    /// Of a variant that goes on from where its trial branched.
    std::string rowOf(Workplace& place, const BranchPoint& point, const Scenario& variant, const RunKey& key) {
        const auto measured =
            measuredRun(experiment_, place.expressions, point, variant, key.seed, [this] { return goesOn(); });
        return rowOf(measured, variant, point.drawn, key);
    }
    std::string rowOf(const Expected<MeasuredRun>& measured, const Scenario& scenario, const DrawnValues& drawn,
                      const RunKey& key) {
        if (!measured) return faultyRow(experiment_, key, measured.error(), commandsOf(key));
        if (measured->result.end == RunEnd::stopped) stop_ = true;
        return experimentRow(experiment_, key, drawn, measured->measurement, measured->result,
                             scenario.scene().tickLength, commandsOf(key));
    }
    RunCommands commandsOf(const RunKey& key) const {
        const Variant& variant = experiment_.variants[key.variant - 1];
        std::string flags = options_.flags ? options_.flags(variant) : "";
        flags += " --trial " + std::to_string(key.trial) + " --seed " + std::to_string(key.seed);
        if (!variant.name.empty()) flags += " --variant " + shellQuoted(variant.name);
        return {options_.command + flags, options_.window + flags};
    }

    void fail(const Error& error) {
        const std::lock_guard lock(mutex_);
        failNow(error);
    }
    void failNow(const Error& error) {
        if (!error_) error_ = error;
        stop_ = true;
    }

    const Experiment& experiment_;
    const ExperimentOptions& options_;
    ResultsFile& file_;
    Workplaces places_;
    std::mutex mutex_;
    std::atomic<bool> stop_{false};
    std::int64_t runs_, done_ = 0;
    std::optional<Error> error_;
};

/// Whether a run is one of those that an experiment asks for.
bool isAsked(const RunKey& key, const Experiment& experiment) {
    return key.trial >= experiment.firstTrial && key.trial - experiment.firstTrial < experiment.trials &&
           key.seed >= experiment.noiseSeed(key.trial, 0) &&
           key.seed - experiment.noiseSeed(key.trial, 0) < experiment.seeds && key.variant >= 1 &&
           key.variant <= experiment.variants.size();
}

}  // namespace

Expected<ExperimentSummary> runExperiment(const Experiment& experiment, const ExperimentOptions& options,
                                          const std::filesystem::path& folder) {
    const double runs =
        static_cast<double>(experiment.trials) * experiment.seeds * static_cast<double>(experiment.variants.size());
    if (runs > static_cast<double>(mostRuns))
        return fail(experiment.file, "asks for more than " + std::to_string(mostRuns) + " runs", 0, "trials");
    // Wrong expressions are told before any run, and before the folder is made.
    Workplace first(experiment, options.loading);
    if (const auto fits = first.maker.check(); !fits) return tl::unexpected(fits.error());
    auto file = ResultsFile::open(folder, options.identity, experimentHeader(experiment));
    if (!file) return tl::unexpected(file.error());
    if (const auto fits =
            file->checkAsked([&](const RunKey& key) { return isAsked(key, experiment); }, "trials and seeds");
        !fits)
        return tl::unexpected(fits.error());
    return ExperimentRunner(experiment, options, *file).runAll();
}

}  // namespace mrose
