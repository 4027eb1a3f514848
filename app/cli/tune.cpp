#include <cstdio>

#include "experiment/batch.h"
#include "plugin_watch.h"
#include "plugins.h"
#include "report/tuning_report.h"
#include "workflow/tune_behaviour.h"

namespace mrose::cli {
namespace {

std::string shortNumber(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/// "9.31 (9.02 to 9.60)"
std::string withInterval(const MeanInterval& interval) {
    return shortNumber(interval.mean) + " (" + shortNumber(interval.low) + " to " + shortNumber(interval.high) + ')';
}

/// How many evaluations are done, and the least cost so far.
class TuningDisplay {
public:
    explicit TuningDisplay(bool quiet) : line_(quiet) {}

    void show(std::int64_t done, std::int64_t all, double best) {
        const Clock::time_point now = Clock::now();
        if (now < next_) return;
        next_ = now + (line_.terminal() ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
        line_.show(std::to_string(done) + " of " + std::to_string(all) + " evaluations" +
                   (best == best ? ", least cost " + shortNumber(best) : ""));
    }
    void clear() { line_.clear(); }
    double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    ProgressLine line_;
    Clock::time_point began_ = Clock::now(), next_ = began_ + std::chrono::seconds(1);
};

void print(const TunedBehaviour& tuned, const TuneRequest& request, double seconds) {
    const TunerResult& result = tuned.summary.result;
    const Tuning& tuning = tuned.tuning;
    if (!result.complete) {
        std::printf("interrupted after %lld runs; the same command goes on with the rest\n",
                    static_cast<long long>(tuned.summary.runs));
        return;
    }
    TextTable table({"", "before", "tuned", "from", "to"});
    for (std::size_t i = 0; i < tuning.options.parameters.size(); ++i) {
        const TunedParameter& parameter = tuning.options.parameters[i];
        table.add({parameter.name, shortNumber(parameter.start), shortNumber(result.candidates[result.best].values[i]),
                   shortNumber(parameter.from), shortNumber(parameter.to)});
    }
    std::fputs(table.text().c_str(), stdout);
    const TuningEvidence evidence = evidenceOf(result);
    std::printf("%s, in %u trials held out, with 95 %% intervals: before %s, tuned %s, change %s\n",
                tuning.costText.c_str(), tuning.options.heldOut, withInterval(evidence.before).c_str(),
                withInterval(evidence.after).c_str(), withInterval(evidence.change).c_str());
    if (tuned.summary.unfamiliar)
        if (const std::string note = tuned.summary.unfamiliar->note(); !note.empty())
            std::printf("Note: %s\n", note.c_str());
    std::printf(
        "%zu candidates, %lld evaluations, in %s%s; %s/settings.toml, report.html written\n", result.candidates.size(),
        static_cast<long long>(result.evaluations), durationText(seconds).c_str(),
        tuned.summary.resumed > 0 ? (", " + std::to_string(tuned.summary.resumed) + " runs done before").c_str() : "",
        request.folder.c_str());
}

int runIt(const TuneRequest& request, const CommonFlags& common) {
    std::optional<TuningDisplay> progress;
    TuneWatch watch;
    watch.opened = [&](const Tuning&) {
        watchInterrupts();
        progress.emplace(common.quiet);
    };
    watch.runBegins = sayPluginsRun;
    watch.progress = [&](std::int64_t done, std::int64_t all, double best) { progress->show(done, all, best); };
    watch.goesOn = [] { return !wasInterrupted(); };
    const auto tuned = tuneBehaviour(request, watch);
    if (progress) progress->clear();
    if (!tuned) return report(tuned.error());
    if (common.json)
        std::puts(tuningJson(tuned->tuning, tuned->summary, request.folder).c_str());
    else
        print(*tuned, request, progress->seconds());
    return tuned->summary.result.complete ? success : interruptedStatus();
}

}  // namespace

Subcommand addTune(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<TuneRequest>();
    request->command = commandLine();
    CLI::App* sub = addSubcommand(
        app, common, "tune", "Search a controller's parameters for the least cost in an experiment's trials",
        "  mrose tune TUNING.toml -o tuned\n"
        "  mrose run navigation.toml --settings tuned/settings.toml\n"
        "What is searched, where and for what cost, the file says (resources/experiments/README.md). What was found\n"
        "is judged in trials held out. Killed or interrupted, the same command goes on where it was.");
    addThreads(*sub, common);
    sub->add_option("TUNING", request->file, "Tuning file, or the name of one that ships")
        ->required()
        ->check(someName());
    addPluginFlags(*sub, request->plugins);
    sub->add_option("-o,--output", request->folder, "The folder for settings.toml, report.html and the runs")
        ->required()
        ->check(someName());
    return {sub, [request, &common] { return runIt(*request, common); }};
}

}  // namespace mrose::cli
