#include <charconv>
#include <cstdio>

#include "plugin_watch.h"
#include "report/program_json.h"
#include "run_count.h"
#include "scenario_flags.h"
#include "workflow/run_batch.h"

namespace mrose::cli {
namespace {

/// "3..7", or "5" alone. nullopt: it is neither.
std::optional<BatchRequest::Seeds> parseSeeds(const std::string& text) {
    const auto number = [](const std::string& digits, std::uint64_t& value) {
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc() && end == digits.data() + digits.size();
    };
    const std::size_t dots = text.find("..");
    BatchRequest::Seeds seeds;
    const std::string last = dots == std::string::npos ? text : text.substr(dots + 2);
    const bool fits =
        number(text.substr(0, dots), seeds.first) && number(last, seeds.last) && seeds.first <= seeds.last;
    return fits ? std::optional(seeds) : std::nullopt;
}

std::string decimals(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

void print(const BatchSummary& summary, const BatchRequest& request, double seconds) {
    const ResultsSummary& results = summary.results;
    if (results.rows > 0) {
        TextTable table({"", "mean", "least", "most"});
        for (const ColumnSummary& column : results.columns)
            table.add({column.name, decimals(column.mean), decimals(column.least), decimals(column.most)});
        std::fputs(table.text().c_str(), stdout);
    }
    if (!request.until.empty())
        std::printf("ended by the condition: %lld of %lld\n", static_cast<long long>(results.ended),
                    static_cast<long long>(results.rows));
    for (const ColumnSummary& column : results.columns)
        if (column.name == unfamiliarColumn && column.mean >= RunStatistics::notableShare)
            std::printf("Note: in %.0f %% of the time some robot is driven as its network has not learned\n",
                        100 * column.mean);
    if (results.faulty > 0) std::printf("with faults: %lld\n", static_cast<long long>(results.faulty));
    printEnd({summary.runs, results.rows, summary.resumed, summary.complete}, seconds, request.folder);
}

int runRuns(BatchRequest request, const std::string& seeds, const CommonFlags& common) {
    if (!seeds.empty()) request.seeds = parseSeeds(seeds);
    if (!seeds.empty() && !request.seeds) {
        std::fprintf(stderr, "mrose: --seeds: %s; expected one seed or a range: 1..20\n", seeds.c_str());
        return usage;
    }
    std::optional<RunCount> progress;
    BatchWatch watch;
    watch.opened = [&](const OpenedScenario& opened) {
        reportNotes(opened.notes);
        watchInterrupts();
        progress.emplace(common.quiet);
    };
    watch.runBegins = sayPluginsRun;
    watch.progress = [&](std::int64_t done, std::int64_t all) { progress->show(done, all); };
    watch.goesOn = [] { return !wasInterrupted(); };
    const auto summary = runBatch(request, watch);
    if (progress) progress->clear();
    if (!summary) return report(summary.error());
    if (common.json)
        std::puts(batchJson(*summary, request.folder).c_str());
    else
        print(*summary, request, progress->seconds());
    return summary->complete ? success : interruptedStatus();
}

}  // namespace

Subcommand addBatch(CLI::App& app, CommonFlags& common) {
    struct Flags {
        BatchRequest request;
        std::string seeds;
    };
    auto flags = std::make_shared<Flags>();
    BatchRequest& request = flags->request;
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
    addScenarioFlags(*sub, request.scenario, request.duration, request.until);
    sub->add_option("--trials", request.trials, "How many starts")
        ->check(CLI::Range(std::int64_t{1}, mostRuns))
        ->capture_default_str();
    sub->add_option("--seeds", flags->seeds,
                    "Seeds of the noise, each with every start: 1..20; otherwise the scenario's")
        ->excludes("--seed");
    sub->callback([sub, flags, &common] {
        if (sub->count("--seed") > 0) flags->request.seeds = {common.seed, common.seed};
    });
    sub->add_option("-o,--output", request.folder, "The folder for results.csv")->required()->check(someName());
    return {sub, [flags, &common] { return runRuns(flags->request, flags->seeds, common); }};
}

}  // namespace mrose::cli
