#include "workflow/predict_windows.h"

#include <algorithm>

#include "assessment/prediction_files.h"
#include "assessment/rollout.h"
#include "io/file.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// Those of the file, of the robots that are asked for.
Expected<std::vector<WindowRequest>> requestedWindows(const PredictRequest& request) {
    auto windows = readWindows(request.windows);
    if (!windows || request.robots.empty()) return windows;
    std::erase_if(*windows, [&](const WindowRequest& window) {
        return std::find(request.robots.begin(), request.robots.end(), window.robot) == request.robots.end();
    });
    return windows;
}

Expected<int> stepsOf(double seconds, Nanoseconds step) {
    const Nanoseconds horizon = fromSeconds(seconds);
    if (horizon % step != 0)
        return fail({}, secondsText(horizon) + " s is no whole number of steps of " + secondsText(step) + " s", 0,
                    "horizon");
    return static_cast<int>(horizon / step);
}

}  // namespace

Expected<PredictedWindows> predictWindows(const PredictRequest& request, const Progress& progress) {
    if (!request.output.empty())
        if (auto can = checkOutput(request.output, {request.network, placeOfLog(request.log), request.windows},
                                   request.overwrite);
            !can)
            return tl::unexpected(can.error());
    const auto motion = openNetwork(request.network);
    if (!motion) return tl::unexpected(motion.error());
    const auto log = openLog(request.log, request.robots, (*motion)->network().drive);
    if (!log) return tl::unexpected(log.error());
    const auto windows = requestedWindows(request);
    if (!windows) return tl::unexpected(windows.error());
    const RolloutOptions options;
    const auto steps = stepsOf(request.horizon, options.step);
    if (!steps) return tl::unexpected(steps.error());
    const auto starts = requestedStarts(*log, *windows, *steps, request.windows);
    if (!starts) return tl::unexpected(starts.error());
    if (!mayGoOn(progress, 0)) return fail(log->source, "was not predicted: cancelled");
    const RobotModels models = learnedModels(*motion, *log);
    const auto predicted = rollOut(named(models), *log, starts->starts, starts->robots, options);
    if (!predicted) return tl::unexpected(predicted.error());
    if (!mayGoOn(progress, 1)) return fail(log->source, "was not predicted: cancelled");
    PredictedWindows result{predicted->size(),
                            predictionsCsv(*log, starts->starts, starts->robots, *predicted, options.step),
                            log->incomplete};
    for (std::string& notice : noticesOf((*motion)->network(), *log)) result.notices.push_back(std::move(notice));
    if (!request.output.empty())
        if (auto written = writeFileAtomically(request.output, result.csv); !written)
            return tl::unexpected(written.error());
    return result;
}

}  // namespace mrose
