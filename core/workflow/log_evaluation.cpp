#include "workflow/log_evaluation.h"

#include <algorithm>
#include <filesystem>

#include "identification/held_out_part.h"
#include "workflow/evaluation_models.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"

namespace mrose {
namespace {

/// The part of the log that the network has never seen.
Expected<Log> heldOutPart(Log log, const MotionNetwork& network, const std::string& path) {
    if (!network.heldOut.part.holdsAny()) return fail(path, "was learned without --hold-out: it has seen its logs");
    const auto& known = network.training.logs;
    for (const LogFile& file : log.files)
        if (std::none_of(known.begin(), known.end(), [&](const auto& source) { return source.hash == file.hash; }))
            return fail(file.path, "is no log that " + path + " was learned from; --held-out is for those");
    return partOf(std::move(log), network.heldOut.part, LogPart::heldOut);
}

/// Their indices.
Expected<std::vector<std::size_t>> chosenWindows(const std::vector<std::size_t>& numbers, std::size_t count) {
    std::vector<std::size_t> indices;
    for (const std::size_t number : numbers) {
        if (number < 1 || number > count)
            return fail({}, "there is no window " + std::to_string(number) + " of " + std::to_string(count), 0,
                        "--show");
        indices.push_back(number - 1);
    }
    return indices;
}

std::string fileName(const std::string& path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

Expected<LogEvaluation> evaluateLog(const LogEvaluationRequest& request, const std::string& commandLine,
                                    const std::function<bool(double share)>& goesOn) {
    const auto motion = openNetwork(request.network);
    if (!motion) return tl::unexpected(motion.error());
    const MotionNetwork& network = (*motion)->network();
    auto log = openLog(request.log, request.robots, network.drive);
    if (log && request.heldOut) log = heldOutPart(std::move(*log), network, request.network);
    if (!log) return tl::unexpected(log.error());
    for (const RobotLog& robot : log->robots)
        for (const Trajectory& trajectory : robot.trajectories)
            if (!trajectory.commands.empty() && !trajectory.poses.empty())
                if (auto overlap = checkOverlap(robot.robot, trajectory); !overlap)
                    return fail(log->source, overlap.error().cause);
    std::vector<RobotModels> models;
    models.push_back(learnedModels(*motion, *log));
    models.back().name = fileName(request.network);
    for (const std::string& path : request.against) {
        const auto other = openNetwork(path);
        if (!other) return tl::unexpected(other.error());
        models.push_back(learnedModels(*other, *log));
        models.back().name = fileName(path);
    }
    for (RobotModels& baseline : kinematicModels(network, *log)) models.push_back(std::move(baseline));
    std::vector<NamedModel> views;
    for (const RobotModels& m : models) views.push_back(named(m));

    EvaluationOptions options;
    options.windows.horizon = fromSeconds(request.horizon);
    options.withFloor = request.withFloor;
    auto evaluation = evaluate(*log, views, options, goesOn);
    if (!evaluation) return tl::unexpected(evaluation.error());
    auto chosen = chosenWindows(request.shown, evaluation->log.windows.size());
    if (!chosen) return tl::unexpected(chosen.error());
    ReportContext context = reportContext(network, request.network, commandLine);
    context.notices = noticesOf(*log);
    for (std::string& notice : noticesOf(network, *log, request.heldOut)) context.notices.push_back(std::move(notice));
    context.chosen = std::move(*chosen);
    return LogEvaluation{std::move(*evaluation), std::move(context)};
}

}  // namespace mrose
