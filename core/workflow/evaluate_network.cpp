#include "workflow/evaluate_network.h"

#include <algorithm>
#include <filesystem>

#include "identification/held_out_part.h"
#include "io/format.h"
#include "io/shell_quoted.h"
#include "motion/driving_reader.h"
#include "motion/kinematic_baselines.h"
#include "workflow/advise_drive.h"
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

/// What a report says about a network.
ReportContext reportContext(const MotionNetwork& network, const EvaluateRequest& request) {
    ReportContext context = contextOf(network.training, request.command);
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
    if (const std::string limits = limitsInWords(network.limits); !limits.empty()) fact("limits of the drive", limits);
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

/// The share of a window's periods in which the robot was driven as the network was never learned.
double unfamiliarShare(const DrivingReader& reader, const MotionNetwork& network, const Log& log, const Window& window,
                       Nanoseconds step) {
    const Trajectory& trajectory = log.robots[window.robot].trajectories[window.trajectory];
    const Nanoseconds end = window.start + window.steps() * step;
    const std::vector<StampedCommand> commands = commandsRead({&trajectory, window.start}, end);
    CommandHistory history;
    std::size_t next = 0;
    double unfamiliar = 0, periods = 0;
    for (Nanoseconds now = window.start; now < end; now += network.period, ++periods) {
        for (; next < commands.size() && commands[next].time <= now; ++next)
            history.issue(commands[next].time, commands[next].command);
        const auto k = static_cast<std::size_t>((now - window.start) / step);
        const Pose moved = relative(window.truth[k], window.truth[k + 1]);
        const double seconds = toSeconds(step);
        unfamiliar += reader.isUnfamiliar({&history, now, {moved.x / seconds, moved.heading / seconds}, {}, {}});
    }
    return unfamiliar / periods;
}

/// By window; empty where the network does not say where it was learned.
std::vector<double> unfamiliarShares(const MotionNetwork& network, const Log& log, const LogWindows& windows) {
    std::vector<double> shares;
    if (!network.familiar) return shares;
    const DrivingReader reader(network.form, *network.familiar);
    for (const Window& window : windows.windows)
        shares.push_back(unfamiliarShare(reader, network, log, window, windows.options.step));
    return shares;
}

std::string robotList(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& one : names) text += (text.empty() ? "" : ",") + one;
    return text;
}

std::string fileName(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// The networks whose noise is judged, beside the mean alone and the constant noise of the first.
class NoiseModels {
public:
    NoiseModels(std::span<const std::shared_ptr<const LearnedMotion>> networks, std::span<const RobotModels> means,
                const Log& log, int samples)
        : means_(means), samples_(samples) {
        for (std::size_t i = 0; i < networks.size(); ++i) {
            if (!networks[i]->network().noise) continue;
            add(i, learnedModels(networks[i], log, MotionDraw::noisy), means[i].name);
            if (i > 0) continue;
            if (networks[i]->network().noise->constant) {
                RobotModels constant = constantNoiseModels(networks[i], log);
                const std::string beside = means[i].name + ", " + constant.name;
                add(i, std::move(constant), beside);
            }
            alone_ = true;
        }
    }

    std::vector<SampledModel> sampled() const {
        std::vector<SampledModel> models;
        for (const auto& [noisy, mean] : noisy_) models.push_back({named(noisy), named(means_[mean]), mean, samples_});
        if (alone_) {
            NamedModel mean = named(means_.front());
            mean.name += ", its mean alone";
            models.push_back({mean, mean, 0, 1});
        }
        return models;
    }

private:
    void add(std::size_t mean, RobotModels models, std::string name) {
        models.name = std::move(name);
        noisy_.emplace_back(std::move(models), mean);
    }

    std::span<const RobotModels> means_;
    int samples_;
    std::vector<std::pair<RobotModels, std::size_t>> noisy_;  ///< with the index of its mean
    bool alone_ = false;
};

/// What to drive next, beside this log; what keeps it from being said is said.
DriveAdvice adviceFor(const EvaluateRequest& request, const Progress& progress) {
    const auto advice = advise({.network = request.network, .logs = {request.log}, .robots = request.robots}, progress);
    if (!advice) return {{}, {}, {}, advice.error().message()};
    DriveAdvice said{
        fixed(advice->drive.duration, 0) + " s, in " + spaceText(advice->drive) + ", " + limitsText(advice->limits),
        {},
        "mrose advise " + shellQuoted(request.network) + " --log " + shellQuoted(request.log) +
            (request.robots.empty() ? "" : " --robots " + shellQuoted(robotList(request.robots))) + " -o next.csv",
        {}};
    said.reasons = partTexts(*advice);
    return said;
}

/// The part of `progress` from one share to another.
Progress stretchOf(const Progress& progress, double from, double to) {
    if (!progress) return {};
    return [progress, from, to](double share) { return progress(from + (to - from) * share); };
}

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
    std::vector<std::shared_ptr<const LearnedMotion>> networks;
    const auto addNetwork = [&](const std::shared_ptr<const LearnedMotion>& opened, const std::string& path) {
        networks.push_back(opened);
        models.push_back(learnedModels(opened, *log));
        models.back().name = fileName(path);
    };
    addNetwork(*motion, request.network);
    for (const std::string& path : request.against) {
        const auto other = openNetwork(path);
        if (!other) return tl::unexpected(other.error());
        addNetwork(*other, path);
    }
    for (RobotModels& baseline : kinematicModels(network, *log)) models.push_back(std::move(baseline));
    std::vector<NamedModel> views;
    for (const RobotModels& m : models) views.push_back(named(m));

    EvaluationOptions options;
    options.windows.horizon = fromSeconds(request.horizon);
    options.withFloor = request.withFloor;
    auto evaluation = evaluate(*log, views, options, stretchOf(progress, 0, 0.5));
    if (!evaluation) return tl::unexpected(evaluation.error());
    const NoiseModels noise(networks, models, *log, request.samples);
    auto forecasts = forecast(*log, evaluation->log, noise.sampled(), stretchOf(progress, 0.5, 0.9));
    if (!forecasts) return tl::unexpected(forecasts.error());
    evaluation->forecasts = std::move(*forecasts);
    auto chosen = chosenWindows(request.shown, evaluation->log.windows.size());
    if (!chosen) return tl::unexpected(chosen.error());
    ReportContext context = reportContext(network, request);
    context.notices = noticesOf(*log);
    for (std::string& notice : noticesOf(network, *log, request.heldOut)) context.notices.push_back(std::move(notice));
    for (std::size_t i = 0; i < request.against.size(); ++i) {
        const MotionNetwork& other = networks[i + 1]->network();
        HoldOut kept = other.heldOut.part;
        kept.guard = network.heldOut.part.guard;
        if (request.heldOut && kept == network.heldOut.part) continue;
        context.notices.push_back(besideNotice(fileName(request.against[i]), other.training, *log));
    }
    std::erase(context.notices, std::string());
    context.chosen = std::move(*chosen);
    context.unfamiliar = unfamiliarShares(network, *log, evaluation->log);
    if (request.withAdvice) {
        context.advice = adviceFor(request, stretchOf(progress, 0.9, 1));
        if (!mayGoOn(progress, 1)) return fail("", "the evaluation was ended before its end");
    }
    return NetworkEvaluation{std::move(*evaluation), std::move(context)};
}

}  // namespace mrose
