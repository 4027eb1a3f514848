#include <cstdio>

#include "common.h"
#include "io/format.h"
#include "workflow/predict_readings.h"
#include "workflow/predict_windows.h"
#include "workflow/resources.h"

namespace mrose::cli {
namespace {

int runPredict(PredictRequest request, const CommonFlags& common) {
    request.overwrite = common.overwrite;
    request.seed = common.seed;
    const auto predicted = predictWindows(request);
    if (!predicted) return report(predicted.error());
    if (common.json) {
        nlohmann::json json{
            {"windows", predicted->windows}, {"predictions", request.output}, {"notices", predicted->notices}};
        if (request.samples > 0) json["samples"] = request.samples;
        std::puts(json.dump(2).c_str());
    } else if (!common.quiet) {
        std::printf("%s: %s of %g s predicted", request.output.c_str(), counted(predicted->windows, "window").c_str(),
                    request.horizon);
        if (request.samples > 0)
            std::printf(", %s of each", counted(static_cast<std::size_t>(request.samples), "sample").c_str());
        std::puts("");
        for (const std::string& notice : predicted->notices) std::printf("Note: %s\n", notice.c_str());
    }
    return success;
}

int runReadings(PredictReadingsRequest request, const CommonFlags& common) {
    request.overwrite = common.overwrite;
    request.seed = common.seed;
    const auto predicted = predictReadings(request);
    if (!predicted) return report(predicted.error());
    if (common.json) {
        const nlohmann::json json{
            {"queries", predicted->queries}, {"predictions", request.output}, {"notices", predicted->notices}};
        std::puts(json.dump(2).c_str());
    } else if (!common.quiet) {
        std::printf("%s: %s predicted, %s of each\n", request.output.c_str(),
                    counted(predicted->queries, "reading").c_str(),
                    counted(static_cast<std::size_t>(request.samples), "sample").c_str());
        for (const std::string& notice : predicted->notices) std::printf("Note: %s\n", notice.c_str());
    }
    return success;
}

}  // namespace

Subcommand addPredict(CLI::App& app, CommonFlags& common) {
    auto request = std::make_shared<PredictRequest>();
    CLI::App* sub = addSubcommand(
        app, common, "predict", "Predict windows of a log open loop, and write the poses",
        "  mrose predict create.net --log MRCLAM_Dataset7 --robots 1,2 --windows windows.csv -o predicted.csv\n"
        "The windows file has the columns dataset,robot,t_start (mrose evaluate --report writes one); the output "
        "dataset,robot,t_start,t,x,y,heading.\n"
        "A prediction uses the commands up to the predicted instant and the ground truth up to t_start, nothing "
        "later.\n"
        "  mrose predict create.net --log MRCLAM_Dataset7 --windows windows.csv --samples 64 --at 1,2,5,10 -o "
        "bands.csv\n"
        "Samples are independent runs of the robot with its learned noise: before t the output has the columns sample, "
        "from 0 on, and seed, that of the run. 64 of them, with --seed 1, are what mrose evaluate judges.\n"
        "  mrose predict create_camera.net --log MRCLAM_Dataset7 --robots 1,2 --queries queries.csv -o samples.csv\n"
        "The queries file has the columns dataset,robot,t,subject; the output "
        "dataset,robot,t,subject,p_detect,sample,\n"
        "range_m,bearing_rad. Of a learned localisation they are robot,t and robot,t,p_report,sample,x,y,heading.\n"
        "Predictions use no reading of the log.\n"
        "dataset is the number of an MRCLAM data set, as 7, and 0 for all other logs.");
    addOverwrite(*sub, common);
    sub->add_option("NET", request->network, "Network file, or the name of one that ships")
        ->required()
        ->transform(placeOfNetwork);
    sub->add_option("--log", request->log, "The log to predict")->required();
    CLI::Option* windows =
        sub->add_option("--windows", request->windows, "Of motion: CSV file that says which windows");
    auto readings = std::make_shared<PredictReadingsRequest>();
    CLI::Option* queries = sub->add_option("--queries", readings->queries,
                                           "Of a sensor: CSV file that says which looks, and which subjects there")
                               ->excludes(windows);
    sub->add_option("-o,--output", request->output, "The CSV file to write")->required()->check(someName());
    sub->add_option("--robots", request->robots,
                    "Predict only these robots, by name: 1,2. The others are there all the same, and occlude")
        ->delimiter(',');
    sub->add_option("--horizon", request->horizon, "Of motion: length of a prediction in s")
        ->check(numberRange(0.1, 3600.0))
        ->capture_default_str()
        ->excludes(queries);
    auto samples = std::make_shared<int>(0);
    sub->add_option(
           "--samples", *samples,
           "Independent draws: of a sensor of each reading, by default 40; of motion of each window, by default "
           "none but the mean")
        ->check(CLI::Range(1, 100000));
    sub->add_option("--at", request->at, "Of motion: write the poses so many s after t_start only: 1,2,5,10")
        ->check(numberRange(0.1, 3600.0))
        ->delimiter(',')
        ->excludes(queries);
    addSeed(*sub, common);
    sub->callback([sub, queries] {
        // A sensor is always sampled.
        if (sub->count("--seed") > 0 && sub->count("--samples") == 0 && queries->empty())
            throw CLI::RequiresError("--seed", "--samples");
    });
    return {sub, [request, readings, samples, windows, queries, &common] {
                if (*queries) {
                    readings->network = request->network;
                    readings->log = request->log;
                    readings->output = request->output;
                    readings->robots = request->robots;
                    if (*samples > 0) readings->samples = *samples;
                    return runReadings(*readings, common);
                }
                if (!*windows) {
                    mrose::cli::report({.cause = "expected --windows of a motion network, or --queries of a sensor"});
                    return static_cast<int>(usage);
                }
                request->samples = *samples;
                return runPredict(*request, common);
            }};
}

}  // namespace mrose::cli
