#include "experiment/batch.h"

#include <charconv>
#include <chrono>
#include <cstdio>

#include "io/file.h"
#include "io/format.h"
#include "io/value_bytes.h"
#include "recording/origin.h"
#include "scenarios.h"
#include "workflow/version.h"
#include "world/seconds_text.h"

namespace mrose::cli {
namespace {

struct BatchCommandFlags {
    RunFlags run;
    std::uint32_t trials = 100;
    std::string seeds, out;
};

/// "3..7", or "5" alone.
bool parseSeeds(const std::string& text, BatchOptions& options) {
    const auto number = [](const std::string& digits, std::uint64_t& value) {
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc() && end == digits.data() + digits.size();
    };
    const std::size_t dots = text.find("..");
    if (dots == std::string::npos) {
        if (!number(text, options.firstSeed)) return false;
        options.lastSeed = options.firstSeed;
        return true;
    }
    return number(text.substr(0, dots), options.firstSeed) && number(text.substr(dots + 2), options.lastSeed) &&
           options.firstSeed <= options.lastSeed;
}

/// What runs a trial alone but for its number and its seed.
std::string runCommand(const RunFlags& flags, Nanoseconds duration) {
    std::string command = "mrose run " + shellQuoted(flags.scenario);
    if (!flags.log.empty()) command += " --log " + shellQuoted(flags.log);
    for (const std::string& assignment : flags.overrides) command += " --set " + shellQuoted(assignment);
    if (flags.plugins.isolate) command += " --isolate";
    if (flags.plugins.limit != PluginFlags().limit) command += " --plugin-limit " + numberText(flags.plugins.limit);
    command += " --duration " + plainSeconds(duration);
    if (!flags.until.empty()) command += " --until " + shellQuoted(flags.until);
    return command;
}

/// The same for a file from wherever it is named; of what ships and of parts of logs, the name.
std::string placeOf(const std::string& name) {
    std::error_code unknown;
    const std::filesystem::path place = std::filesystem::canonical(name, unknown);
    return unknown ? name : place.string();
}

/// What all rows depend on. How plug-ins are kept from doing harm is no part of it: a batch that one of them has ended
/// goes on with --isolate.
BatchIdentity identityOf(const OpenScenario& open, const RunFlags& flags, Nanoseconds duration) {
    BatchIdentity identity{{"mrose", std::string(MROSE_VERSION) + ' ' + thisOrigin().commit},
                           {"scenario", placeOf(open.loaded.value.name())},
                           {"--duration", plainSeconds(duration)}};
    if (!flags.until.empty()) identity["--until"] = flags.until;
    if (!flags.log.empty()) identity["--log"] = placeOf(flags.log);
    const std::string content(contentOf);
    for (const Value::File& file : open.loaded.value.files())
        identity[content + placeOf(file->name)] = hexadecimal(hashOf(file->content));
    for (const auto& [path, hash] : open.plugins) identity[content + placeOf(path)] = hash;
    return identity;
}

/// Shows how far the batch is.
class BatchProgress {
public:
    explicit BatchProgress(bool quiet) : line_(quiet) {}

    void show(std::int64_t done, std::int64_t all) {
        const Clock::time_point now = Clock::now();
        if (doneBefore_ < 0) doneBefore_ = done - 1;
        if (now < next_) return;
        next_ = now + (line_.terminal() ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
        const double each = seconds() / static_cast<double>(done - doneBefore_);
        line_.show(std::to_string(done) + " of " + std::to_string(all) + " runs, " +
                   durationText(each * static_cast<double>(all - done)) + " left");
    }
    void clear() { line_.clear(); }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    ProgressLine line_;
    Clock::time_point began_ = Clock::now(), next_ = began_ + std::chrono::seconds(1);
    std::int64_t doneBefore_ = -1;
};

void printJson(const BatchSummary& summary, const std::string& folder) {
    nlohmann::json json{{"runs", summary.runs},
                        {"done", summary.results.rows},
                        {"resumed", summary.resumed},
                        {"ended_by_condition", summary.results.ended},
                        {"faulty", summary.results.faulty},
                        {"complete", summary.complete}};
    if (summary.complete) json["results"] = folder + "/results.csv";
    std::puts(json.dump(2).c_str());
}

std::string decimals(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

void print(const BatchSummary& summary, const BatchCommandFlags& flags, double seconds) {
    const ResultsSummary& results = summary.results;
    if (results.rows > 0) {
        TextTable table({"", "mean", "least", "most"});
        for (const ColumnSummary& column : results.columns)
            table.add({column.name, decimals(column.mean), decimals(column.least), decimals(column.most)});
        std::fputs(table.text().c_str(), stdout);
    }
    if (!flags.run.until.empty())
        std::printf("ended by the condition: %lld of %lld\n", static_cast<long long>(results.ended),
                    static_cast<long long>(results.rows));
    if (results.faulty > 0) std::printf("with faults: %lld\n", static_cast<long long>(results.faulty));
    if (!summary.complete) {
        std::printf("interrupted after %lld of %lld runs; the same command goes on with the rest\n",
                    static_cast<long long>(results.rows), static_cast<long long>(summary.runs));
        return;
    }
    const std::string before =
        summary.resumed > 0 ? ", " + std::to_string(summary.resumed) + " of them done before" : "";
    std::printf("%lld run%s in %s%s; results in %s/results.csv\n", static_cast<long long>(summary.runs),
                summary.runs == 1 ? "" : "s", durationText(seconds).c_str(), before.c_str(), flags.out.c_str());
}

int runAll(const BatchCommandFlags& flags, const CommonFlags& common) {
    BatchOptions options;
    if (!flags.seeds.empty() && !parseSeeds(flags.seeds, options)) {
        std::fprintf(stderr, "mrose: --seeds: %s; expected one seed or a range: 1..20\n", flags.seeds.c_str());
        return usage;
    }
    const auto open = openScenario(flags.run, 0);
    if (!open) return report(open.error());
    if (const auto until = openCondition(flags.run.until, *open->scenario); !until) return report(until.error());
    const ScenarioParts& parts = open->scenario->parts();
    if (flags.seeds.empty()) options.firstSeed = options.lastSeed = flags.run.seed.value_or(parts.seed);
    options.trials = flags.trials;
    options.duration = flags.run.duration ? fromSeconds(*flags.run.duration) : parts.duration;
    options.until = flags.run.until;
    options.command = runCommand(flags.run, options.duration);
    options.value = std::make_shared<const ScenarioValue>(open->loaded.value);
    options.identity = identityOf(*open, flags.run, options.duration);
    options.begins = [](const RunKey& key) { sayPluginsRun(key); };
    watchInterrupts();
    BatchProgress progress(common.quiet);
    options.progress = [&](std::int64_t done, std::int64_t all) { progress.show(done, all); };
    options.goesOn = [] { return !wasInterrupted(); };
    const auto summary = runBatch(parts, options, flags.out);
    progress.clear();
    if (!summary) return report(summary.error());
    if (common.json)
        printJson(*summary, flags.out);
    else
        print(*summary, flags, progress.seconds());
    if (!summary->complete) return interruptedStatus();
    return success;
}

}  // namespace

Subcommand addBatch(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<BatchCommandFlags>();
    CLI::App* sub = addSubcommand(
        app, common, "batch", "Run many trials of a scenario, one row of results each",
        "  mrose batch soccer.toml --trials 1000 -o games\n"
        "  mrose batch soccer.toml --trials 50 --seeds 1..20 --until 'goals[1] + goals[2] > 0' -o goals\n"
        "Every trial starts elsewhere, as [variation] in the scenario says; every seed has another noise. Killed or\n"
        "interrupted, the same command goes on where it was, with more --trials too, and with --isolate where a "
        "plug-in\nhas ended it. Each row has the command that runs its trial alone, and the starts and parameters that "
        "vary.");
    addSeed(*sub, common);
    addThreads(*sub, common);
    addRunFlags(*sub, flags->run);
    sub->add_option("--trials", flags->trials, "How many starts")
        ->check(CLI::Range(std::int64_t{1}, mostRuns))
        ->capture_default_str();
    sub->add_option("--seeds", flags->seeds,
                    "Seeds of the noise, each with every start: 1..20; otherwise the scenario's")
        ->excludes("--seed");
    sub->callback([sub, flags, &common] {
        if (sub->count("--seed") > 0) flags->run.seed = common.seed;
    });
    sub->add_option("-o,--output", flags->out, "The folder for results.csv")->required()->check(someName());
    return {sub, [flags, &common] { return runAll(*flags, common); }};
}

}  // namespace mrose::cli
