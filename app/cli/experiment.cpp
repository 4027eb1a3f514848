#include <cmath>
#include <cstdio>

#include "experiment/batch.h"
#include "io/format.h"
#include "plugin_watch.h"
#include "plugins.h"
#include "report/program_json.h"
#include "run_count.h"
#include "scenario_flags.h"
#include "workflow/run_experiment.h"

namespace mrose::cli {
namespace {

std::string numberOf(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

void print(const ExperimentSummary& summary, const ExperimentRequest& request, double seconds) {
    for (const VariantSummary& variant : summary.variants) {
        if (variant.runs == 0) continue;
        if (!variant.name.empty()) std::printf("%s\n", variant.name.c_str());
        TextTable table({"", "mean", "95 % interval", "deviation", "least", "most", "of"});
        for (const MeasureSummary& measure : variant.measures) {
            const auto cell = [&](double value) { return measure.count > 0 ? numberOf(value) : "-"; };
            const Estimate& of = measure.estimate;
            const bool known = std::isfinite(of.low);
            const std::string range = known ? '(' + numberOf(of.low) + " to " + numberOf(of.high) + ')' : "";
            // What is left of a sum that cancels is none.
            const double mean = std::abs(measure.mean) < 1e-12 * measure.deviation ? 0 : measure.mean;
            table.add({measure.name, cell(mean), range, cell(measure.deviation), cell(measure.least),
                       cell(measure.most), std::to_string(measure.count)});
        }
        if (!variant.measures.empty()) std::fputs(table.text().c_str(), stdout);
        std::fputs(counted(static_cast<std::size_t>(variant.runs), "run").c_str(), stdout);
        if (summary.until) std::printf(", %lld ended by `until`", static_cast<long long>(variant.ended));
        if (variant.faulty > 0)
            std::printf(", %lld by a fault, the first: %s", static_cast<long long>(variant.faulty),
                        variant.firstFault.c_str());
        std::puts("");
    }
    printEnd({summary.runs, summary.done, summary.resumed, summary.complete}, seconds, request.folder);
}

int runIt(const ExperimentRequest& request, const CommonFlags& common) {
    std::optional<RunCount> progress;
    ExperimentWatch watch;
    watch.opened = [&](const Experiment&) {
        watchInterrupts();
        progress.emplace(common.quiet);
    };
    watch.runBegins = sayPluginsRun;
    watch.progress = [&](std::int64_t done, std::int64_t all) { progress->show(done, all); };
    watch.goesOn = [] { return !wasInterrupted(); };
    const auto summary = runExperiment(request, watch);
    if (progress) progress->clear();
    if (!summary) return report(summary.error());
    if (common.json)
        std::puts(experimentJson(*summary, request.folder).c_str());
    else
        print(*summary, request, progress->seconds());
    return summary->complete ? success : interruptedStatus();
}

}  // namespace

Subcommand addExperiment(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<ExperimentRequest>();
    CLI::App* sub = addSubcommand(
        app, common, "experiment", "Run the trials of an experiment, one row of features and measures each",
        "  mrose experiment time_to_target.toml -o episodes\n"
        "What varies from trial to trial, what is asked at the start and measured at the end, the file says\n"
        "(resources/experiments/README.md). Killed or interrupted, the same command goes on where it was, with more\n"
        "--trials too. Each row has the commands that repeat its run alone, and in the window.");
    addThreads(*sub, common);
    sub->add_option("EXPERIMENT", request->file, "Experiment file, or the name of one that ships")
        ->required()
        ->check(someName());
    sub->add_option("--trials", request->trials, "How many; otherwise as many as the file says")
        ->check(CLI::Range(std::int64_t{1}, mostRuns));
    addChangeFlags(*sub, request->settings, request->overrides);
    addPluginFlags(*sub, request->plugins);
    sub->add_option("-o,--output", request->folder, "The folder for results.csv")->required()->check(someName());
    return {sub, [request, &common] {
                request->command = commandLine();
                return runIt(*request, common);
            }};
}

}  // namespace mrose::cli
