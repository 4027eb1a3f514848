#include <cstdio>

#include "common.h"
#include "compare_divergence.h"
#include "compare_sensors.h"
#include "io/format.h"
#include "plugins.h"
#include "report/comparison_files.h"
#include "report/comparison_report.h"
#include "workflow/compare_log.h"
#include "world/seconds_text.h"

namespace mrose::cli {
namespace {

struct CompareFlags {
    CompareRequest what;
    std::string folder;
};

void printComparison(const LogComparison& compared) {
    const Comparison& comparison = compared.comparison;
    const Nanoseconds step = comparison.log.options.step;
    const RolloutRequest& first = comparison.requests.front();
    const bool one = comparison.requests.size() == 1;
    std::printf("%s beside %s, seed %llu: %s of %s s, %sfrom %s s on\n\n", comparison.scenario.c_str(),
                comparison.log.source.c_str(), static_cast<unsigned long long>(comparison.seed),
                one ? "a rollout" : (std::to_string(comparison.requests.size()) + " rollouts").c_str(),
                secondsText(first.steps * step, 0).c_str(), one ? "" : "the first ",
                secondsText(first.start, 0).c_str());
    TextTable table({"", "rollouts", "windows", "P %", "Hd %", "final cm", "final deg", "touches"});
    const auto add = [&](const std::string& name, const ComparedSummary& s) {
        table.add({name, std::to_string(s.rollouts()), std::to_string(s.of(RolloutUse::counted)), fixed(s.counted.p, 2),
                   fixed(s.counted.hd, 2), fixed(100 * s.positionFinal.median, 2),
                   fixed(degrees * s.headingFinal.median, 2), std::to_string(s.touches)});
    };
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) add(comparison.robots[i].name, comparison.summaries[i]);
    if (comparison.robots.size() > 1) add("all", comparison.all);
    std::fputs(table.text().c_str(), stdout);
    std::puts(
        "\nwindows: rollouts with ground truth throughout in which the robot moves; P: time-mean position error over "
        "path,\nHd: time-mean heading error over rotation, summed over these windows. final: median errors at the end "
        "of the\nrollouts. touches: how often the simulated robot began to touch something.");
    printDivergences(comparison, compared.divergences);
    printSensors(comparison);
    std::vector<std::string> notes = compared.context.notices;
    for (std::string& remark : remarksOn(comparison)) notes.push_back(std::move(remark));
    if (!notes.empty()) std::puts("");
    for (const std::string& note : notes) std::printf("Note: %s\n", note.c_str());
}

/// Shows how far the search for causes is.
class CausesDisplay {
public:
    explicit CausesDisplay(bool quiet) : line_(quiet) {}

    bool operator()(double share) {
        const int percent = static_cast<int>(100 * share);
        const int apart = line_.terminal() ? 1 : 25;
        if (percent / apart != shown_ / apart || shown_ < 0) line_.show("causes: " + std::to_string(percent) + " %");
        shown_ = percent;
        return !wasInterrupted();
    }
    void clear() { line_.clear(); }

private:
    ProgressLine line_;
    int shown_ = -1;  ///< %
};

int compareScenario(const CompareFlags& flags, const CommonFlags& common) {
    if (!flags.folder.empty())
        if (const auto writable = checkComparisonFolder(flags.folder, common.overwrite); !writable)
            return report(writable.error());
    watchInterrupts();
    CausesDisplay causes(common.quiet);
    const auto compared = compareLog(flags.what, {goesOn, std::ref(causes)});
    causes.clear();
    if (wasInterrupted()) return reportInterrupted();
    if (!compared) return report(compared.error());
    const auto& [world, comparison, divergences, context] = *compared;
    if (common.json)
        std::fputs(comparisonJson(comparison, context.notices, &divergences).c_str(), stdout);
    else
        printComparison(*compared);
    if (flags.folder.empty()) return success;
    if (const auto written = writeComparison(comparison, world.parts().scene, context, flags.folder, &divergences);
        !written)
        return report(written.error());
    if (!common.json)
        std::printf("\nreport: %s\n", (std::filesystem::path(flags.folder) / "report.html").string().c_str());
    return success;
}

}  // namespace

Subcommand addCompare(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<CompareFlags>();
    flags->what.command = commandLine();
    CLI::App* sub = addSubcommand(
        app, common, "compare", "Put simulated robots beside the real ones whose log they play, with their errors",
        "  mrose compare --log MRCLAM_Dataset6\n"
        "  mrose compare --log mine.csv --robot husky.toml --every 2\n"
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset6 --every 10 --report comparison\n"
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset7 --robots 1,2 --start 120 --duration 30\n"
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset7 --robots 1,2 --windows windows.csv\n"
        "  mrose compare --log MRCLAM_Dataset7 --windows all --duration 5\n"
        "  mrose compare mrclam_replay.toml --log MRCLAM_Dataset6 --start 120 --duration 60 --model mine.net\n"
        "Each rollout begins with the poses and velocities of the real robots and the commands before; from there on "
        "the simulation gets their commands alone. It collides with what is in the world; mrose predict knows no "
        "contacts.");
    addSeed(*sub, common);
    addThreads(*sub, common);
    addOverwrite(*sub, common);
    CLI::Option* scenario = sub->add_option(
        "SCENARIO", flags->what.scenario,
        "Scenario file, or the name of one that ships, with robots that play a log; without it one is made "
        "for the log: its robots alone, Creates of MRCLAM in the arena of these logs");
    sub->add_option("--robot", flags->what.robotFile,
                    "Without a scenario: robot file, or the name of one that ships, of what drove, where the log does "
                    "not say it (CSV)")
        ->excludes(scenario);
    sub->get_option("--seed")->default_str("the scenario's");
    sub->add_option("--log", flags->what.log, "The log to play and to compare with")->required();
    sub->add_option("--robots", flags->what.robots,
                    "Only these robots, by their names in the log: 1,2; the others are not in the world")
        ->delimiter(',');
    CLI::Option* start = sub->add_option("--start", flags->what.start,
                                         "Where in the log to begin, in s after all of its robots are there")
                             ->check(numberRange(0.0, 1e7))
                             ->capture_default_str();
    sub->add_option("--duration", flags->what.duration,
                    "How long to compare, in s; otherwise what the scenario says, with --every to the log's end, with "
                    "--windows 10; without a scenario a log of short trajectories is cut as mrose evaluate does")
        ->check(numberRange(0.1, 1e7));
    CLI::Option* every =
        sub->add_option("--every", flags->what.every, "Start again from the real robots every so many s")
            ->check(numberRange(0.1, 1e7));
    sub->add_option("--windows", flags->what.windows,
                    "CSV file that says which windows, as for mrose predict: a rollout for each; all: of the length "
                    "--duration, as mrose evaluate cuts the log")
        ->excludes(start)
        ->excludes(every);
    sub->add_option(
           "--report", flags->folder,
           "Folder for report.html, errors.csv, rollouts.csv, results.json and, where log and robots have a sensor "
           "of one name, readings.csv")
        ->check(someName());
    addDivergenceFlags(*sub, flags->what.divergence);
    addPluginFlags(*sub, flags->what.plugins);
    sub->callback([sub, flags, &common] {
        if (sub->count("--seed") > 0) flags->what.seed = common.seed;
    });
    return {sub, [flags, &common] { return compareScenario(*flags, common); }};
}

}  // namespace mrose::cli
