#include "experiment/experiment.h"

#include <atomic>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>

#include "experiment/batch.h"
#include "experiment/branching.h"
#include "experiment/experiment_row.h"
#include "experiment/trial.h"
#include "io/shell_quoted.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

/// What one thread at a time works with.
struct Workplace {
    TrialExpressions expressions;
    TrialMaker maker;
    Workplace(const Experiment& experiment, const ScenarioLoading& loading)
        : expressions(experiment), maker(experiment, expressions, loading) {}
};

/// As many as there are threads that ask at once.
class Workplaces {
public:
    Workplaces(const Experiment& experiment, const ScenarioLoading& loading)
        : experiment_(experiment), loading_(loading) {}

    std::unique_ptr<Workplace> take() {
        const std::lock_guard lock(mutex_);
        if (free_.empty()) return std::make_unique<Workplace>(experiment_, loading_);
        auto place = std::move(free_.back());
        free_.pop_back();
        return place;
    }
    void giveBack(std::unique_ptr<Workplace> place) {
        const std::lock_guard lock(mutex_);
        free_.push_back(std::move(place));
    }

private:
    const Experiment& experiment_;
    const ScenarioLoading& loading_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Workplace>> free_;
};

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
        for (std::uint32_t trial = 1; trial <= experiment_.trials; ++trial)
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
        if (summary.complete)
            if (const auto finished = file_.finish(); !finished) return tl::unexpected(finished.error());
        return summary;
    }

private:
    RunKey keyOf(std::uint32_t trial, std::size_t variant, std::uint32_t k) const {
        return {trial, experiment_.seed + k, static_cast<std::uint32_t>(variant) + 1};
    }
    bool isMissing(std::uint32_t trial) const {
        for (std::size_t variant = 0; variant < experiment_.variants.size(); ++variant)
            for (std::uint32_t k = 0; k < experiment_.seeds; ++k)
                if (!file_.has(keyOf(trial, variant, k))) return true;
        return false;
    }

    void runTrial(Workplace& place, std::uint32_t number) {
        auto trial = place.maker.make(number);
        if (!trial) return fail(trial.error());
        std::optional<BranchPoint> point;
        if (trial->before) {
            if (options_.loaded) options_.loaded(trial->before->parts);
            auto come = runToBranch(experiment_, place.expressions, std::move(trial->before->parts), trial->drawn,
                                    [this] { return goesOn(); });
            if (!come) return fail(come.error());
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
                const std::lock_guard lock(mutex_);
                if (stop_) return;
                if (!row) return failNow(row.error());
                if (const auto kept = file_.add(key, *row); !kept) return failNow(kept.error());
                ++done_;
                if (options_.progress) options_.progress(done_, runs_);
            }
        }
    }

    bool goesOn() const { return !stop_ && (!options_.goesOn || options_.goesOn()); }

    Expected<std::string> rowOf(Workplace& place, const Scenario& scenario, const DrawnValues& drawn,
                                const RunKey& key) {
        WorldState start = scenario.initialState(key.seed);
        const std::vector<RobotInsight> none(start.robots.size());
        const Moment atStart{.scenario = &scenario, .state = &start, .insights = none, .drawn = &drawn};
        const auto expressions = place.expressions.of(atStart);
        if (!expressions) return tl::unexpected(expressions.error());
        TrialMeasurement measurement(experiment_, **expressions, lookEvery(scenario));
        if (const auto begun = measurement.begin(atStart); !begun) return tl::unexpected(begun.error());
        return measuredRow(scenario, std::move(start), drawn, key, **expressions, measurement);
    }
    /// Of a variant that goes on from where its trial branched.
    Expected<std::string> rowOf(Workplace& place, const BranchPoint& point, const Scenario& variant,
                                const RunKey& key) {
        const std::vector<RobotInsight> none(point.before.state.robots.size());
        const Moment atBranch{
            .scenario = point.scenario.get(), .state = &point.before.state, .insights = none, .drawn = &point.drawn};
        const auto expressions = place.expressions.of(atBranch);
        if (!expressions) return tl::unexpected(expressions.error());
        TrialMeasurement measurement(experiment_, **expressions, lookEvery(variant));
        if (!point.isReached()) {
            measurement.skip();
            RunResult result = point.before;
            if (result.end == RunEnd::duration) result.end = RunEnd::noBranch;
            return experimentRow(experiment_, key, point.drawn, measurement, result, variant.scene().tickLength,
                                 commandsOf(key));
        }
        if (const auto begun = measurement.begin(atBranch); !begun) return tl::unexpected(begun.error());
        return measuredRow(variant, branchedState(point, variant, key.seed), point.drawn, key, **expressions,
                           measurement);
    }
    Nanoseconds lookEvery(const Scenario& scenario) const {
        return ticksBetweenLooks(experiment_, scenario.scene()) * scenario.scene().tickLength;
    }
    RunCommands commandsOf(const RunKey& key) const {
        std::string flags = " --trial " + std::to_string(key.trial) + " --seed " + std::to_string(key.seed);
        if (const std::string& variant = experiment_.variants[key.variant - 1].name; !variant.empty())
            flags += " --variant " + shellQuoted(variant);
        return {options_.command + flags, options_.window + flags};
    }

    Expected<std::string> measuredRow(const Scenario& scenario, WorldState start, const DrawnValues& drawn,
                                      const RunKey& key, const CompiledExpressions& expressions,
                                      TrialMeasurement& measurement) {
        RunOptions options;
        options.duration = scenario.parts().duration;
        options.endOnFault = true;
        options.watchFollows = expressions.follows;
        options.every = ticksBetweenLooks(experiment_, scenario.scene());
        options.drawn = &drawn;
        options.watch = [&](const Moment& at) { return measurement.look(at); };
        std::optional<Error> wrong;
        options.finally = [&](const Moment& at) {
            if (const auto ended = measurement.end(at); !ended) wrong = ended.error();
        };
        options.each = [this](const WorldState&, const StepTrace&) { return goesOn(); };
        const auto result = run(scenario, std::move(start), options);
        if (!result) return tl::unexpected(result.error());
        if (wrong) return tl::unexpected(*wrong);
        if (result->end == RunEnd::stopped) stop_ = true;
        return experimentRow(experiment_, key, drawn, measurement, *result, scenario.scene().tickLength,
                             commandsOf(key));
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
    return key.trial >= 1 && key.trial <= experiment.trials && key.seed >= experiment.seed &&
           key.seed - experiment.seed < experiment.seeds && key.variant >= 1 &&
           key.variant <= experiment.variants.size();
}

}  // namespace

std::int64_t ticksBetweenLooks(const Experiment& experiment, const Scene& scene) {
    return std::max<std::int64_t>(1, experiment.every / scene.tickLength);
}

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
