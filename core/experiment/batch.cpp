#include "experiment/batch.h"

#include <atomic>
#include <mutex>
#include <optional>
#include <vector>

#include "condition/condition.h"
#include "experiment/results_file.h"
#include "experiment/run.h"
#include "io/file.h"
#include "learning/parallel_for.h"
#include "scenario/value_file.h"
#include "scenario/variation.h"

namespace mrose {
namespace {

constexpr const char* conditionSource = "--until";

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
    /// The run's row.
    Expected<std::string> rowOf(const RunKey& key) {
        auto parts = varied(parts_, key.trial);
        if (!parts) return tl::unexpected(parts.error());
        const Scenario scenario(std::move(*parts));
        const auto result = runOf(scenario, key);
        if (!result) return tl::unexpected(result.error());
        if (result->end == RunEnd::stopped) stop_ = true;
        const std::string command =
            options_.command + " --trial " + std::to_string(key.trial) + " --seed " + std::to_string(key.seed);
        return resultsRow(key, *result, scenario.parts(), command);
    }

    Expected<RunResult> runOf(const Scenario& scenario, const RunKey& key) {
        std::optional<Condition> until;
        if (!options_.until.empty()) {
            auto compiled = compileCondition(options_.until, scenario, conditionSource);
            if (!compiled) return tl::unexpected(compiled.error());
            until.emplace(std::move(*compiled));
        }
        RunOptions options;
        options.duration = options_.duration;
        options.until = until ? &*until : nullptr;
        options.goesOn = [this](const WorldState&) { return !stop_ && (!options_.goesOn || options_.goesOn()); };
        return run(scenario, scenario.initialState(key.seed), options);
    }

    void runOne(const RunKey& key) {
        if (options_.begins) options_.begins(key);
        const auto row = rowOf(key);
        const std::lock_guard lock(mutex_);
        if (stop_) return;
        if (!row) return failIn(key, row.error());
        if (const auto kept = file_.add(key, *row); !kept) return fail(kept.error());
        ++done_;
        if (options_.progress) options_.progress(done_, runs_);
    }

    void failIn(const RunKey& key, Error error) {
        error.cause += " (trial " + std::to_string(key.trial) + ", seed " + std::to_string(key.seed) + ')';
        fail(error);
    }
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

/// Whether a run is one of those that a batch asks for.
bool isAsked(const RunKey& key, const BatchOptions& options) {
    return key.trial >= options.firstTrial && key.trial - options.firstTrial < options.trials &&
           key.seed >= options.firstSeed && key.seed <= options.lastSeed;
}

}  // namespace

Expected<BatchSummary> runBatch(const ScenarioParts& parts, const BatchOptions& options,
                                const std::filesystem::path& folder) {
    if (runsOf(options) < 0)
        return fail("", std::to_string(options.trials) + " trials with " +
                            std::to_string(options.lastSeed - options.firstSeed + 1) +
                            " seeds each are too many runs; expected at most " + std::to_string(mostRuns));
    if (!options.until.empty())  // wrong conditions are reported before any run
        if (const auto compiled = compileCondition(options.until, Scenario(parts), conditionSource); !compiled)
            return tl::unexpected(compiled.error());
    auto file = ResultsFile::open(folder, options.identity, resultsHeader(parts));
    if (!file) return tl::unexpected(file.error());
    if (const auto fits =
            file->checkAsked([&](const RunKey& key) { return isAsked(key, options); }, "--trials and --seeds");
        !fits)
        return tl::unexpected(fits.error());
    auto summary = BatchRunner(parts, options, *file).runAll();
    if (summary && summary->complete && options.value)
        // What is there may be of a batch whose results were removed.
        if (auto kept = writeFileAtomically(folder / "scenario.value", valueFileText(*options.value)); !kept)
            return tl::unexpected(kept.error());
    return summary;
}

}  // namespace mrose
