#include <cstdio>

#include "assessment/evaluate.h"
#include "assessment/prediction_files.h"
#include "common.h"
#include "io/file.h"
#include "io/format.h"
#include "workflow/evaluation_models.h"
#include "workflow/notices.h"
#include "workflow/resources.h"
#include "world/seconds_text.h"

namespace mrose::cli {
namespace {

struct PredictFlags {
    std::string network, log, windows, out;
    std::vector<std::string> robots;
    double horizon = 10;
};

int predict(const PredictFlags& flags, const CommonFlags& common) {
    if (const auto writable =
            checkOutput(flags.out, {flags.network, placeOfLog(flags.log), flags.windows}, common.overwrite);
        !writable)
        return report(writable.error());
    const auto motion = openNetwork(flags.network);
    if (!motion) return report(motion.error());
    const auto log = openLog(flags.log, flags.robots, (*motion)->network().drive);
    if (!log) return report(log.error());
    auto requests = readWindows(flags.windows);
    if (!requests) return report(requests.error());
    if (!flags.robots.empty())
        std::erase_if(*requests, [&](const WindowRequest& request) {
            return std::find(flags.robots.begin(), flags.robots.end(), request.robot) == flags.robots.end();
        });
    const RolloutOptions options;
    const Nanoseconds horizon = fromSeconds(flags.horizon);
    if (horizon % options.step != 0)
        return report({{},
                       0,
                       0,
                       "horizon",
                       secondsText(horizon) + " s is no whole number of steps of " + secondsText(options.step) + " s"});
    const int steps = static_cast<int>(horizon / options.step);
    const auto starts = requestedStarts(*log, *requests, steps, flags.windows);
    if (!starts) return report(starts.error());
    const RobotModels models = learnedModels(*motion, *log);
    const auto predicted = rollOut(named(models), *log, starts->starts, starts->robots, options);
    if (!predicted) return report(predicted.error());
    const std::string csv = predictionsCsv(*log, starts->starts, starts->robots, *predicted, options.step);
    if (const auto written = writeFileAtomically(flags.out, csv); !written) return report(written.error());
    std::vector<std::string> notices = log->incomplete;
    for (std::string& notice : noticesOf((*motion)->network(), *log)) notices.push_back(std::move(notice));
    if (common.json)
        std::puts(nlohmann::json{{"windows", predicted->size()}, {"predictions", flags.out}, {"notices", notices}}
                      .dump(2)
                      .c_str());
    else if (!common.quiet) {
        std::printf("%s: %zu windows of %g s predicted\n", flags.out.c_str(), predicted->size(), flags.horizon);
        for (const std::string& notice : notices) std::printf("Note: %s\n", notice.c_str());
    }
    return success;
}

}  // namespace

Subcommand addPredict(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<PredictFlags>();
    CLI::App* sub = addSubcommand(
        app, common, "predict", "Predict windows of a log open loop, and write the poses",
        "  mrose predict create.net --log MRCLAM_Dataset7 --robots 1,2 --windows windows.csv -o predicted.csv\n"
        "The windows file has the columns dataset,robot,t_start (mrose evaluate --report writes one); the output "
        "dataset,robot,t_start,t,x,y,heading.\n"
        "A prediction uses the commands up to the predicted instant and the ground truth up to t_start, nothing "
        "later.");
    addOverwrite(*sub, common);
    sub->add_option("NET", flags->network, "Network file")->required();
    sub->add_option("--log", flags->log, "The log to predict")->required();
    sub->add_option("--windows", flags->windows, "CSV file that says which windows")->required();
    sub->add_option("-o,--output", flags->out, "The CSV file to write")->required()->check(someName());
    sub->add_option("--robots", flags->robots, "Only these robots, by name: 1,2")->delimiter(',');
    sub->add_option("--horizon", flags->horizon, "Length of a prediction in s")
        ->check(numberRange(0.1, 3600.0))
        ->capture_default_str();
    return {sub, [flags, &common] { return predict(*flags, common); }};
}

}  // namespace mrose::cli
