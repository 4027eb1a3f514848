#include <cstdio>

#include "common.h"
#include "workflow/predict_windows.h"

namespace mrose::cli {
namespace {

int runPredict(PredictRequest request, const CommonFlags& common) {
    request.overwrite = common.overwrite;
    const auto predicted = predictWindows(request);
    if (!predicted) return report(predicted.error());
    if (common.json) {
        const nlohmann::json json{
            {"windows", predicted->windows}, {"predictions", request.output}, {"notices", predicted->notices}};
        std::puts(json.dump(2).c_str());
    } else if (!common.quiet) {
        std::printf("%s: %zu windows of %g s predicted\n", request.output.c_str(), predicted->windows, request.horizon);
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
        "later.");
    addOverwrite(*sub, common);
    sub->add_option("NET", request->network, "Network file")->required();
    sub->add_option("--log", request->log, "The log to predict")->required();
    sub->add_option("--windows", request->windows, "CSV file that says which windows")->required();
    sub->add_option("-o,--output", request->output, "The CSV file to write")->required()->check(someName());
    sub->add_option("--robots", request->robots, "Only these robots, by name: 1,2")->delimiter(',');
    sub->add_option("--horizon", request->horizon, "Length of a prediction in s")
        ->check(numberRange(0.1, 3600.0))
        ->capture_default_str();
    return {sub, [request, &common] { return runPredict(*request, common); }};
}

}  // namespace mrose::cli
