#include "workflow/predict_windows.h"

#include <algorithm>

#include "assessment/prediction_files.h"
#include "assessment/rollout.h"
#include "io/file.h"
#include "io/format.h"
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

Expected<int> stepsOf(double seconds, Nanoseconds step, const std::string& key) {
    const Nanoseconds horizon = fromSeconds(seconds);
    if (horizon % step != 0)
        return fail({}, secondsText(horizon) + " s is no whole number of steps of " + secondsText(step) + " s", 0, key);
    return static_cast<int>(horizon / step);
}

/// The steps whose poses are asked for.
Expected<std::vector<std::size_t>> instantsOf(const PredictRequest& request, int steps, Nanoseconds step) {
    std::vector<std::size_t> instants;
    for (const double seconds : request.at) {
        const auto instant = stepsOf(seconds, step, "at");
        if (!instant) return tl::unexpected(instant.error());
        if (*instant < 1 || *instant > steps)
            return fail({},
                        secondsText(fromSeconds(seconds)) + " s is not within a window of " +
                            secondsText(fromSeconds(request.horizon)) + " s",
                        0, "at");
        const auto index = static_cast<std::size_t>(*instant);
        if (std::find(instants.begin(), instants.end(), index) != instants.end())
            return fail({}, secondsText(fromSeconds(seconds)) + " s is there twice", 0, "at");
        instants.push_back(index);
    }
    return instants;
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
    if (request.samples > 0 && !(*motion)->network().noise)
        return fail(request.network, "knows its mean alone; samples need a network that was learned with its noise");
    RolloutOptions options;
    const auto steps = stepsOf(request.horizon, options.step, "horizon");
    if (!steps) return tl::unexpected(steps.error());
    auto instants = instantsOf(request, *steps, options.step);
    if (!instants) return tl::unexpected(instants.error());
    auto starts = requestedStarts(*log, *windows, *steps, request.windows);
    if (!starts) return tl::unexpected(starts.error());
    const bool sampled = request.samples > 0;
    const RobotModels models = learnedModels(*motion, *log, sampled ? MotionDraw::noisy : MotionDraw::mean);
    TrackerHistories histories;
    fillTracked(named(models), *log, starts->starts, starts->robots, histories);
    PredictionsCsv rows(*log, *starts, options.step, sampled, std::move(*instants));
    const int runs = std::max(1, request.samples);
    for (int k = 0; k <= runs; ++k) {
        if (!mayGoOn(progress, static_cast<double>(k) / runs)) return fail(log->source, "was not predicted: cancelled");
        if (k == runs) break;
        for (std::size_t i = 0; sampled && i < starts->starts.size(); ++i) {
            RolloutStart& start = starts->starts[i];
            start.seed =
                sampleSeed(request.seed, log->robots[starts->robots[i]].robot, start, static_cast<std::uint32_t>(k));
        }
        const auto predicted = rollOut(named(models), *log, starts->starts, starts->robots, options);
        if (!predicted) return tl::unexpected(predicted.error());
        rows.add(*predicted, k);
    }
    PredictedWindows result{starts->starts.size(), rows.text(), log->incomplete};
    const auto beyond = static_cast<std::size_t>(std::ranges::count_if(starts->starts, [&](const RolloutStart& start) {
        const std::vector<StampedCommand>& commands = start.trajectory->commands;
        return commands.empty() || commands.back().time < start.time + *steps * options.step - nanosecondsPerSecond;
    }));
    if (beyond > 0)
        result.notices.push_back(counted(beyond, "window") + (beyond == 1 ? " goes" : " go") +
                                 " on for more than 1 s after the log's last command, which is held until the end.");
    for (std::string& notice : noticesOf((*motion)->network(), *log)) result.notices.push_back(std::move(notice));
    if (!request.output.empty())
        if (auto written = writeFileAtomically(request.output, result.csv); !written)
            return tl::unexpected(written.error());
    return result;
}

}  // namespace mrose
