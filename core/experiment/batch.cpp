#include "experiment/batch.h"

#include <atomic>
#include <cstdio>
#include <mutex>
#include <optional>
#include <vector>

#include "condition/condition.h"
#include "experiment/results_file.h"
#include "experiment/run.h"
#include "experiment/variation.h"
#include "io/file.h"
#include "io/number_text.h"
#include "learning/parallel_for.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

std::string hexadecimal(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

/// A cell that may hold commas and quotes, on one line.
std::string cell(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c < ' ' && c >= 0 ? ' ' : c);
    return out + '"';
}

std::string shellQuoted(const std::string& word) {
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + '\'';
}

std::string headerLine(const Scene& scene) {
    std::string line = "trial,seed,end,time_s,touches,kicks,hits,faults,driven_m";
    for (const Goal& goal : scene.environment.goals) line += ',' + cell("goals " + goal.name);
    return line + ",world_hash,command,first_fault";
}

std::string rowOf(const BatchOptions& options, const RunKey& key, const RunResult& result, Nanoseconds tick) {
    double driven = 0;
    for (const double d : result.statistics.driven) driven += d;
    const RunStatistics& s = result.statistics;
    std::string line = std::to_string(key.trial) + ',' + std::to_string(key.seed) + ',' + name(result.end) + ',' +
                       numberText(toSeconds(result.state.tick * tick)) + ',' + std::to_string(s.touches) + ',' +
                       std::to_string(s.kicks) + ',' + std::to_string(s.hits) + ',' + std::to_string(s.faults) + ',' +
                       numberText(driven);
    for (const std::int32_t goals : s.goals) line += ',' + std::to_string(goals);
    std::string command = options.command + " --trial " + std::to_string(key.trial) + " --seed " +
                          std::to_string(key.seed) + " --duration " + numberText(toSeconds(options.duration));
    if (!options.until.empty()) command += " --until " + shellQuoted(options.until);
    return line + ',' + hexadecimal(hashOf(result.state).world) + ',' + cell(command) + ',' + cell(s.firstFault);
}

/// Runs of one batch, on any thread.
class BatchRunner {
public:
    BatchRunner(const ScenarioParts& parts, const BatchOptions& options, ResultsFile& file)
        : parts_(parts), options_(options), file_(file) {}

    Expected<BatchSummary> runAll() {
        std::vector<RunKey> missing;
        for (std::uint32_t t = 0; t < options_.trials; ++t)
            for (std::uint64_t seed = options_.firstSeed; seed <= options_.lastSeed; ++seed)
                if (const RunKey key{options_.firstTrial + t, seed}; !file_.has(key)) missing.push_back(key);
        const auto seeds = static_cast<std::int64_t>(options_.lastSeed - options_.firstSeed + 1);
        summary_.runs = options_.trials * seeds;
        summary_.resumed = summary_.runs - static_cast<std::int64_t>(missing.size());
        done_ = summary_.resumed;
        parallelFor(missing.size(), [&](std::size_t i) {
            if (!stop_) runOne(missing[i]);
        });
        if (error_) return tl::unexpected(*error_);
        summary_.complete = done_ == summary_.runs;
        if (summary_.complete)
            if (const auto finished = file_.finish(); !finished) return tl::unexpected(finished.error());
        return summary_;
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
        return run(scenario, scenario.initialState(key.seed), options);
    }

    void runOne(const RunKey& key) {
        const auto result = runOf(key);
        const std::lock_guard lock(mutex_);
        if (stop_) return;
        if (!result) return fail(result.error());
        if (const auto kept = file_.add(key, rowOf(options_, key, *result, parts_.scene.tickLength)); !kept)
            return fail(kept.error());
        summary_.ended += result->end == RunEnd::condition ? 1 : 0;
        summary_.faulty += result->statistics.faults > 0 ? 1 : 0;
        ++done_;
        if (options_.progress && !options_.progress(done_, summary_.runs)) stop_ = true;
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
    std::int64_t done_ = 0;
    BatchSummary summary_;
    std::optional<Error> error_;
};

std::string identity(const BatchOptions& options) {
    return "scenario " + options.scenarioHash + "\nduration " + numberText(toSeconds(options.duration)) + "\nuntil " +
           options.until + "\ntrials " + std::to_string(options.firstTrial) + " " + std::to_string(options.trials) +
           "\nseeds " + std::to_string(options.firstSeed) + " " + std::to_string(options.lastSeed) + '\n';
}

}  // namespace

Expected<BatchSummary> runBatch(const ScenarioParts& parts, const BatchOptions& options,
                                const std::filesystem::path& folder) {
    if (!options.until.empty())  // wrong conditions are told before any run
        if (const auto compiled = compileCondition(options.until, Scenario(parts)); !compiled)
            return tl::unexpected(compiled.error());
    auto file = ResultsFile::open(folder, identity(options), headerLine(parts.scene));
    if (!file) return tl::unexpected(file.error());
    return BatchRunner(parts, options, *file).runAll();
}

}  // namespace mrose
