#include <cstdio>

#include "experiment/batch.h"
#include "io/format.h"
#include "plugin_watch.h"
#include "plugins.h"
#include "report/program_json.h"
#include "report/validation_text.h"
#include "run_count.h"
#include "workflow/validate_behaviour.h"

namespace mrose::cli {
namespace {

std::string estimateText(const MeasureValidation& of, const Estimate& estimate, bool difference) {
    return (difference ? differenceText(of.measure, estimate) : measuredText(of.measure, estimate)) + " (" +
           intervalText(of.measure, estimate) + ')';
}

void print(const Validation& validation, const ValidationResult& result) {
    for (const MeasureValidation& of : result.measures) {
        TextTable cells({of.measure.name, validation.before, validation.after, "gain"});
        for (const bool real : {false, true}) {
            const std::size_t first = ValidationCell{false, real}.place();
            cells.add({real ? validation.reality : validation.simulation, estimateText(of, of.cells[first], false),
                       estimateText(of, of.cells[first + 1], false), estimateText(of, of.gain[real ? 1 : 0], true)});
        }
        std::fputs(cells.text().c_str(), stdout);
        std::printf("gain ratio, %s over %s: %s; %s", validation.reality.c_str(), validation.simulation.c_str(),
                    survivesText(of).c_str(), counted(of.trials.size(), "trial").c_str());
        if (of.leftOut > 0)
            std::printf(", %zu more left out: not all of their runs gave a number for %s", of.leftOut,
                        of.measure.name.c_str());
        std::printf("\nin %s: %s, %s; %s, %s\n\n", validation.reality.c_str(), validation.before.c_str(),
                    gainWithIntervalText(of.measure, negated(of.worse[0])).c_str(), validation.after.c_str(),
                    gainWithIntervalText(of.measure, negated(of.worse[1])).c_str());
    }
    for (const CellRuns& cell : result.cells)
        if (cell.faulty > 0)
            std::printf("%s: a fault ended %lld of %lld runs, which are left out\n", cell.name.c_str(),
                        static_cast<long long>(cell.faulty), static_cast<long long>(cell.runs));
    const AccountResult& account = result.account;
    std::printf(account.sparedHours() > 0 ? "%.2f h of real robots spared" : "no hours of real robots spared",
                account.sparedHours());
    std::printf(": %.2f h simulated", account.simulatedHours);
    if (validation.account.simulatedHours > 0)
        std::printf(" (%.2f h of them by learning and tuning)", validation.account.simulatedHours);
    if (account.resetHours > 0) std::printf(" and %.2f h to set robots up", account.resetHours);
    if (account.logMinutes) std::printf(", less %.2f h of logs", *account.logMinutes / 60);
    std::puts("");
}

int runIt(ValidateRequest request, const CommonFlags& common) {
    std::optional<RunCount> progress;
    ExperimentWatch watch;
    watch.opened = [&](const Experiment&) {
        watchInterrupts();
        progress.emplace(common.quiet);
    };
    watch.runBegins = sayPluginsRun;
    watch.progress = [&](std::int64_t done, std::int64_t all) { progress->show(done, all); };
    watch.goesOn = [] { return !wasInterrupted(); };
    request.seconds = [&] { return progress ? progress->seconds() : 0; };
    const auto validated = validateBehaviour(request, watch);
    if (progress) progress->clear();
    if (!validated) return report(validated.error());
    const ExperimentSummary& summary = validated->summary;
    reportNotes(validated->validation.notes);
    if (common.json) {
        std::puts(validated->result ? validationJson(validated->validation, *validated->result, request.folder).c_str()
                                    : experimentJson(summary, request.folder).c_str());
    } else {
        if (validated->result) print(validated->validation, *validated->result);
        printEnd({summary.runs, summary.done, summary.resumed, summary.complete}, progress->seconds(), request.folder);
        if (summary.complete)
            std::printf("%s/report.html; mrose-gui %s/disagreements.csv opens where they disagree most\n",
                        request.folder.c_str(), request.folder.c_str());
    }
    return summary.complete ? success : interruptedStatus();
}

}  // namespace

Subcommand addValidate(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<ValidateRequest>();
    request->commandLine = commandLine();
    CLI::App* sub = addSubcommand(
        app, common, "validate", "Run controllers before and after they learned, in the simulator and in a reality",
        "  mrose validate faster_turns.toml -o validated\n"
        "The reality is one that nothing was learned in: the reference robot, ball and cameras (synthetic), or what\n"
        "was measured. Gains are paired by trial; a page says what of them holds there, and where simulator and\n"
        "reality disagree most (resources/experiments/README.md). Killed, the same command goes on where it was.");
    addThreads(*sub, common);
    sub->add_option("VALIDATION", request->file, "Validation file, or the name of one that ships")
        ->required()
        ->check(someName());
    sub->add_option("--trials", request->trials, "How many, at most as many as the file says")
        ->check(CLI::Range(std::int64_t{1}, mostRuns));
    addPluginFlags(*sub, request->plugins);
    sub->add_option("-o,--output", request->folder, "The folder for results.csv and the page")
        ->required()
        ->check(someName());
    return {sub, [request, &common] { return runIt(*request, common); }};
}

}  // namespace mrose::cli
