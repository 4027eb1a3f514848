#include <cstdio>

#include "common.h"
#include "evaluate_sensor.h"
#include "io/file.h"
#include "io/format.h"
#include "kicker.h"
#include "learning/network_file.h"
#include "report/evaluation_files.h"
#include "report/evaluation_report.h"
#include "workflow/evaluate_network.h"
#include "workflow/resources.h"
#include "world/seconds_text.h"

namespace mrose::cli {
namespace {

struct EvaluateFlags {
    EvaluateRequest what;
    std::string folder;
    bool families = false;
    std::vector<const CLI::Option*> ofMotion = {}, ofSensors = {};  ///< that only such networks know
    std::vector<const CLI::Option*> notOfKickers = {};
};

std::string robotList(const Evaluation& evaluation) {
    std::string text;
    for (const auto& robot : evaluation.log.robots) text += (text.empty() ? "" : ", ") + robot.name;
    return text;
}

/// Steady motion and the rest apart, where a log distinguishes them.
void printStates(const Evaluation& evaluation) {
    TextTable table({"", "windows", "P %", "Hd %", "final / path %", "by steps %"});
    bool any = false;
    for (const Assessment& model : evaluation.models)
        for (const GroupSummary& group : model.groups) {
            if (group.kind != "state") continue;
            any = true;
            const Summary& s = group.summary;
            table.add({model.name + ", " + group.name, std::to_string(s.windows), fixed(s.p, 2), fixed(s.hd, 2),
                       fixed(s.positionFinalOverPath.median, 2), fixed(s.positionFinalOverPathBySteps.median, 2)});
        }
    if (!any) return;
    std::printf("\n%s\nfinal / path: medians; the path is summed over 0.5 s, or over steps of %s s.\n",
                table.text().c_str(), secondsText(evaluation.log.options.step, 1).c_str());
}

/// What the networks' noise is worth.
void printForecasts(const Evaluation& evaluation) {
    if (evaluation.forecasts.empty()) return;
    TextTable table({"", "energy cm", "heading deg", "moves cm", "miss"});
    for (const Forecast& forecast : evaluation.forecasts)
        table.add({forecast.name, fixed(100 * forecast.energy(), 2), fixed(degrees * forecast.heading(), 2),
                   fixed(100 * forecast.moves, 2), knownText(forecast.miss(), 1)});
    std::string instants;
    for (const ForecastAt& at : evaluation.forecasts.front().at)
        instants += (instants.empty() ? "" : ", ") + secondsText(at.time, at.time % nanosecondsPerSecond == 0 ? 0 : 1);
    std::printf(
        "\n%s\n%d runs of each window, judged after %s s. energy, heading: sums of the position's energy score and of "
        "the\nheading's CRPS, the less the better; moves: energy scores of the displacements between; miss: how many "
        "points the\nshares of what happened inside the runs' central 50 and 90 %% are off at most.\n",
        table.text().c_str(), evaluation.forecasts.front().samples, instants.c_str());
}

void printTable(const Evaluation& evaluation, const std::vector<std::string>& notices) {
    int steps = 0;
    for (const Window& window : evaluation.log.windows) steps = std::max(steps, window.steps());
    const bool synthetic = evaluation.log.synthetic;
    std::printf("%s%s, robot %s: %zu windows of %s s, open loop\n\n", evaluation.log.source.c_str(),
                synthetic ? " (synthetic)" : "", robotList(evaluation).c_str(), evaluation.log.windows.size(),
                secondsText(evaluation.log.options.step * steps, 0).c_str());
    TextTable table({synthetic ? "synthetic" : "", "P %", "Hd %", "median pos. %", "final cm", "final deg"});
    for (const Assessment& model : evaluation.models)
        table.add({model.name, fixed(model.all.p, 2), fixed(model.all.hd, 2),
                   fixed(model.all.positionMeanOverPath.median, 2), fixed(100 * model.all.positionFinal.median, 2),
                   fixed(model.all.headingFinal.median * 57.29577951308232, 2)});
    const auto addFloor = [&](const std::optional<Floor>& floor, const std::string& what) {
        if (floor && !floor->pairs.empty())
            table.add({"floor, " + std::to_string(floor->pairs.size()) + " pairs " + what, fixed(floor->best.p, 2),
                       fixed(floor->best.hd, 2)});
    };
    addFloor(evaluation.log.floor, "of like commands");
    addFloor(evaluation.log.turningFloor, "that turn, 5 s");
    std::fputs(table.text().c_str(), stdout);
    std::puts(
        "\nP: time-mean position error over path; Hd: time-mean heading error over rotation, summed over windows.\n"
        "median pos.: of the windows' P; final: median errors at the end of a window.");
    if (evaluation.log.floor && !evaluation.log.floor->pairs.empty())
        std::puts(
            "floor: what the best prediction of its pairs would leave: how far two real runs are apart, over 1.41.");
    printForecasts(evaluation);
    printStates(evaluation);
    if (!notices.empty()) std::puts("");
    for (const std::string& notice : notices) std::printf("Note: %s\n", notice.c_str());
}

int runEvaluate(const EvaluateFlags& flags, const CommonFlags& common) {
    if (!flags.folder.empty())
        if (const auto writable = checkReportFolder(flags.folder, common.overwrite); !writable)
            return report(writable.error());
    watchInterrupts();
    EvaluateRequest request = flags.what;
    request.withAdvice = !flags.folder.empty();
    const auto evaluated = evaluateNetwork(request, goesOn);
    if (wasInterrupted()) return reportInterrupted();
    if (!evaluated) return report(evaluated.error());
    const Evaluation& evaluation = evaluated->evaluation;
    const ReportContext& context = evaluated->context;
    if (common.json)
        std::puts(resultsJson(evaluation, context).c_str());
    else
        printTable(evaluation, context.notices);
    if (flags.folder.empty()) return success;
    if (const auto written = writeReport(evaluation, context, flags.folder); !written) return report(written.error());
    if (!common.json)
        std::printf("\nreport: %s\n", (std::filesystem::path(flags.folder) / "report.html").string().c_str());
    return success;
}

/// Error: a flag that was given and that is for networks of another kind than this one, `own`.
Expected<void> checkFlags(const std::vector<const CLI::Option*>& others, const char* otherKind,
                          const std::string& network, const char* own) {
    for (const CLI::Option* option : others)
        if (*option)
            return fail({}, "is for networks of " + std::string(otherKind) + "; " + network + " is of " + own, 0,
                        option->get_name());
    return {};
}

/// Whether a network file is of a kicker; one that cannot be read is not.
bool isKickerFile(const std::string& path) {
    const auto text = readFile(path);
    return text && networkKind(*text) == KickNetwork::kind;
}

int runKicker(const EvaluateFlags& flags, const CommonFlags& common) {
    for (const auto& [options, kind] : {std::pair{&flags.ofMotion, "motion"}, std::pair{&flags.ofSensors, "sensors"},
                                        std::pair{&flags.notOfKickers, "motion and sensors"}})
        if (const auto fits = checkFlags(*options, kind, flags.what.network, "a kicker"); !fits) {
            report(fits.error());
            return usage;
        }
    return runEvaluateKicker({flags.what.network, flags.what.log, flags.what.robots, flags.what.command}, flags.folder,
                             common);
}

int runAny(const EvaluateFlags& flags, const CommonFlags& common) {
    if (isKickerFile(flags.what.network)) return runKicker(flags, common);
    const auto sensor = isSensorFile(flags.what.network);
    if (!sensor) return runEvaluate(flags, common);  // which names the first thing wrong, the report's folder too
    const auto fits = *sensor ? checkFlags(flags.ofMotion, "motion", flags.what.network, "a sensor")
                              : checkFlags(flags.ofSensors, "sensors", flags.what.network, "motion");
    if (!fits) {
        report(fits.error());
        return usage;
    }
    if (!*sensor) return runEvaluate(flags, common);
    EvaluateSensorRequest request{flags.what.network, flags.what.log, flags.what.robots, flags.what.against};
    request.families = flags.families;
    request.command = flags.what.command;
    if (isLocaliserFile(flags.what.network)) return runEvaluateLocaliser(request, flags.folder, common);
    return runEvaluateSensor(request, flags.folder, common);
}

}  // namespace

Subcommand addEvaluate(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<EvaluateFlags>();
    flags->what.command = commandLine();
    CLI::App* sub = addSubcommand(
        app, common, "evaluate", "Say how true a learned robot, sensor or kicker is: predictions against a log",
        "  mrose evaluate create.net --log MRCLAM_Dataset7 --robots 1,2 --report report\n"
        "  mrose evaluate create.net --log MRCLAM_Dataset7 --against create_paper.net --json\n"
        "  mrose evaluate create.net --log MRCLAM_Dataset7 --report report --show 12,40\n"
        "  mrose evaluate husky.net --log husky_windows.csv --held-out\n"
        "  mrose evaluate create_camera.net --log MRCLAM_Dataset7 --robots 1,2 --families --report seen\n"
        "  mrose evaluate my_kicker.net --log more_kicks\n"
        "The log should be one that the network was not learned from, or the part of it held out.\n"
        "Sensors are those that report landmarks or robots, and a robot's own localisation.");
    addOverwrite(*sub, common);
    sub->add_option("NET", flags->what.network, "Network file, or the name of one that ships")
        ->required()
        ->transform(placeOfNetwork);
    sub->add_option("--log", flags->what.log, "The log to compare with")->required();
    sub->add_option("--robots", flags->what.robots, "Only these robots, by name: 1,2")->delimiter(',');
    flags->notOfKickers.push_back(
        sub->add_option("--against", flags->what.against, "Other network files, beside it in all tables and pictures")
            ->transform(placeOfNetwork));
    flags->ofSensors.push_back(
        sub->add_flag("--families", flags->families,
                      "Of a sensor: beside it the other two of network, lookup table and decision trees, learned from "
                      "the logs that its file names"));
    flags->ofMotion.push_back(sub->add_option("--horizon", flags->what.horizon, "Of motion: length of a window in s")
                                  ->check(numberRange(0.5, 3600.0))
                                  ->capture_default_str());
    CLI::Option* folder =
        sub->add_option("--report", flags->folder,
                        "Folder for report.html, results.csv, results.json and windows.csv, of a sensor cases.csv, "
                        "of a localisation poses.csv (all three for mrose predict), of a kicker kicks.csv")
            ->check(someName());
    flags->ofMotion.push_back(
        sub->add_option("--samples", flags->what.samples, "Of motion with noise: rollouts of each window that judge it")
            ->check(CLI::Range(19, 4096))
            ->capture_default_str());
    flags->ofMotion.push_back(sub->add_option("--show", flags->what.shown,
                                              "Of motion: windows whose paths the report shows too, by number: 12,40")
                                  ->delimiter(',')
                                  ->needs(folder));
    flags->ofMotion.push_back(
        sub->add_flag("--held-out", flags->what.heldOut,
                      "Of motion: only the part of the log that mrose train --hold-out kept from learning"));
    flags->ofMotion.push_back(sub->add_flag_callback(
        "--no-floor", [flags] { flags->what.withFloor = false; }, "Of motion: do not compare near-identical commands"));
    return {sub, [flags, &common] { return runAny(*flags, common); }};
}

}  // namespace mrose::cli
