#include "workflow/evaluate_network.h"

#include <algorithm>
#include <filesystem>

#include "identification/held_out_part.h"
#include "io/format.h"
#include "motion/kinematic_baselines.h"
#include "workflow/log_files.h"
#include "workflow/notices.h"
#include "workflow/version.h"

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

/// What a report says about a network.
ReportContext reportContext(const MotionNetwork& network, const EvaluateRequest& request) {
    ReportContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = request.command;
    for (const auto& source : network.training.logs) context.trainingLogs.push_back({source.path, source.hash});
    const auto fact = [&](const char* name, std::string value) {
        context.modelFacts.emplace_back(name, std::move(value));
    };
    fact("file", request.network);
    fact("form", network.form == MotionNetwork::Form::state
                     ? "state: (v, w, commands) to motion and next velocity"
                     : "history: commands of the last tenths of a second to motion");
    fact("robot", network.robotType + (network.synthetic ? " (synthetic)" : ""));
    fact("period", fixed(1000 * toSeconds(network.period), 0) + " ms");
    fact("layers", std::to_string(network.mlp.shape.inputs) + " inputs, " + std::to_string(network.mlp.shape.hidden) +
                       " tanh, " + std::to_string(network.mlp.shape.outputs) + " outputs");
    for (const MotionNetwork::Identified& robot : network.identified)
        fact("dead time", "robot " + robot.robot + ": v " + fixed(1000 * robot.v.deadTime, 0) + " ± " +
                              fixed(1000 * robot.v.deadTimeError, 0) + " ms, w " + fixed(1000 * robot.w.deadTime, 0) +
                              " ± " + fixed(1000 * robot.w.deadTimeError, 0) + " ms");
    fact("learned by", network.training.method + ", loss " + network.training.loss + ", seed " +
                           std::to_string(network.training.seed) + ", " + std::to_string(network.training.patterns) +
                           " patterns, " + std::to_string(network.training.epochs) + " epochs");
    fact("command", network.training.command);
    if (network.heldOut.part.holdsAny()) fact("kept from learning", keptFromLearning(network.heldOut.part));
    fact("held out in learning", "P " + fixed(network.heldOut.position, 2) + " %, Hd " +
                                     fixed(network.heldOut.heading, 2) + " % over " +
                                     fixed(network.heldOut.horizon, 1) + " s (each member on its own part)");
    return context;
}

/// What a network is compared with: velocity = command; the same after the identified dead time; with lag, gains and
/// biases as well. Their parameters were identified from the logs that the network was learned from.
std::vector<RobotModels> kinematicModels(const MotionNetwork& network, const Log& log) {
    // A command acts when it was issued, not at the next period of some network.
    constexpr Nanoseconds period = 10'000'000;
    std::vector<RobotModels> baselines;
    const std::vector<KinematicBaseline> kinds = kinematicBaselines(network, {});
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        RobotModels& models = baselines.emplace_back(RobotModels{kinds[i].name, {}});
        for (const RobotLog& robot : log.robots)
            models.byRobot.emplace(robot.robot, std::make_unique<KinematicModel>(
                                                    kinematicBaselines(network, robot.robot)[i].parameters, period));
    }
    return baselines;
}

std::string fileName(const std::string& path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

Expected<NetworkEvaluation> evaluateNetwork(const EvaluateRequest& request, const Progress& progress) {
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
    auto evaluation = evaluate(*log, views, options, progress);
    if (!evaluation) return tl::unexpected(evaluation.error());
    auto chosen = chosenWindows(request.shown, evaluation->log.windows.size());
    if (!chosen) return tl::unexpected(chosen.error());
    ReportContext context = reportContext(network, request);
    context.notices = noticesOf(*log);
    for (std::string& notice : noticesOf(network, *log, request.heldOut)) context.notices.push_back(std::move(notice));
    context.chosen = std::move(*chosen);
    return NetworkEvaluation{std::move(*evaluation), std::move(context)};
}

}  // namespace mrose
