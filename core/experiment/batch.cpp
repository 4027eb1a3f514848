#include "experiment/batch.h"

#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include "condition/condition.h"
#include "experiment/results_file.h"
#include "experiment/run.h"
#include "experiment/variation.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

/// -1 where they are too many.
std::int64_t runsOf(const BatchOptions& options) {
    const std::uint64_t more = options.lastSeed - options.firstSeed;
    if (more >= static_cast<std::uint64_t>(mostRuns)) return -1;
    const std::int64_t runs = static_cast<std::int64_t>(more + 1) * options.trials;
    return runs > mostRuns ? -1 : runs;
}

/// Runs of one batch, on any thread.
class BatchRunner {
public:
    BatchRunner(const ScenarioParts& parts, const BatchOptions& options, ResultsFile& file)
        : parts_(parts), options_(options), file_(file), runs_(runsOf(options)) {}

    Expected<BatchSummary> runAll() {
        std::vector<RunKey> missing;
        for (std::uint32_t t = 0; t < options_.trials; ++t)
            for (std::uint64_t i = 0; i <= options_.lastSeed - options_.firstSeed; ++i)
                if (const RunKey key{options_.firstTrial + t, options_.firstSeed + i}; !file_.has(key))
                    missing.push_back(key);
        done_ = runs_ - static_cast<std::int64_t>(missing.size());
        BatchSummary summary{runs_, done_, ResultsSummary(parts_.scene)};
        parallelFor(missing.size(), [&](std::size_t i) {
            if (!stop_) runOne(missing[i]);
        });
        if (error_) return tl::unexpected(*error_);
        for (const auto& [key, row] : file_.rows()) summary.results.add(row);
        summary.complete = done_ == runs_;
        if (summary.complete)
            if (const auto finished = file_.finish(); !finished) return tl::unexpected(finished.error());
        return summary;
    }

private:
    Expected<RunResult> runOf(const RunKey& key) {
        auto parts = varied(parts_, key.trial);
        if (!parts) return tl::unexpected(parts.error());
        const Scenario scenario(std::move(*parts));
        std::optional<Condition> until;
        if (!options_.until.empty()) {
            auto compiled = compileCondition(options_.until, scenario);
            if (!compiled) return tl::unexpected(compiled.error());
            until.emplace(std::move(*compiled));
        }
        RunOptions options;
        options.duration = options_.duration;
        options.until = until ? &*until : nullptr;
        options.each = [this](const WorldState&, const StepTrace&) {
            return !stop_ && (!options_.goesOn || options_.goesOn());
        };
        return run(scenario, scenario.initialState(key.seed), options);
    }

    void runOne(const RunKey& key) {
        const auto result = runOf(key);
        const std::lock_guard lock(mutex_);
        if (stop_) return;
        if (!result) return fail(result.error());
        if (result->end == RunEnd::stopped) return stopAll();
        const std::string command =
            options_.command + " --trial " + std::to_string(key.trial) + " --seed " + std::to_string(key.seed);
        if (const auto kept = file_.add(key, resultsRow(key, *result, parts_.scene.tickLength, command)); !kept)
            return fail(kept.error());
        ++done_;
        if (options_.progress) options_.progress(done_, runs_);
    }

    void stopAll() { stop_ = true; }
    void fail(const Error& error) {
        error_ = error;
        stop_ = true;
    }

    const ScenarioParts& parts_;
    const BatchOptions& options_;
    ResultsFile& file_;
    std::mutex mutex_;
    std::atomic<bool> stop_{false};
    std::int64_t runs_, done_ = 0;
    std::optional<Error> error_;
};

std::string identityOf(const BatchOptions& options) {
    return options.identity + '\n' + options.command + "\ntrials " + std::to_string(options.firstTrial) + " and " +
           std::to_string(options.trials - 1) + " more\nseeds " + std::to_string(options.firstSeed) + " to " +
           std::to_string(options.lastSeed) + '\n';
}

}  // namespace

Expected<BatchSummary> runBatch(const ScenarioParts& parts, const BatchOptions& options,
                                const std::filesystem::path& folder) {
    if (runsOf(options) < 0)
        return fail("", std::to_string(options.trials) + " trials with " +
                            std::to_string(options.lastSeed - options.firstSeed + 1) +
                            " seeds each are too many runs; expected at most " + std::to_string(mostRuns));
    if (!options.until.empty())  // wrong conditions are told before any run
        if (const auto compiled = compileCondition(options.until, Scenario(parts)); !compiled)
            return tl::unexpected(compiled.error());
    auto file = ResultsFile::open(folder, identityOf(options), resultsHeader(parts.scene));
    if (!file) return tl::unexpected(file.error());
    return BatchRunner(parts, options, *file).runAll();
}

}  // namespace mrose
