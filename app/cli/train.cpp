#include <chrono>
#include <cmath>
#include <cstdio>

#include "common.h"
#include "identification/robot_identification.h"
#include "io/file.h"
#include "io/format.h"
#include "learning_logs.h"
#include "robot_traits.h"
#include "train_flags.h"
#include "workflow/notices.h"
#include "workflow/resources.h"

namespace mrose::cli {
namespace {

/// Every robot's name once, in the order of the logs.
std::vector<std::string> robotNames(const std::vector<Log>& logs) {
    std::vector<std::string> names;
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            if (std::find(names.begin(), names.end(), robot.robot) == names.end()) names.push_back(robot.robot);
    return names;
}

/// A robot that measures its own velocity is predicted from it, any other one from its commands.
std::string modelFor(const std::vector<Log>& logs) {
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                if (trajectory.measuredVelocity.empty()) return "history";
    return "velocity";
}

/// Shows how learning goes, and how long it still takes at most.
class TrainingDisplay {
public:
    explicit TrainingDisplay(bool quiet) : line_(quiet) {}

    bool operator()(const NetworkProgress& p) {
        const double done = p.member + static_cast<double>(p.epoch) / p.epochs;
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin_;
        const int tenth = static_cast<int>(10 * done / p.members);
        if (line_.terminal() || tenth != shownTenth_) {
            shownTenth_ = tenth;
            char text[200];
            std::snprintf(text, sizeof text,
                          "network %d of %d, epoch %d: loss %.3e, held out P %.2f %% Hd %.2f %%, at most %s left",
                          p.member + 1, p.members, p.epoch, p.loss, p.heldOut.position, p.heldOut.heading,
                          durationText(spent.count() / done * (p.members - done)).c_str());
            line_.show(text);
        }
        return !wasInterrupted();
    }

private:
    ProgressLine line_;
    int shownTenth_ = -1;  ///< of all epochs
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

void printSummary(const TrainedNetwork& summary, const TrainFlags& flags, const CommonFlags& common, double seconds) {
    const MotionNetwork& n = summary.network;
    if (common.json) {
        std::puts(nlohmann::json{{"network", flags.out},
                                 {"patterns", n.training.patterns},
                                 {"epochs", n.training.epochs},
                                 {"seconds", seconds},
                                 {"held_out_windows", n.heldOut.windows},
                                 {"held_out_position_percent", n.heldOut.position},
                                 {"held_out_heading_percent", n.heldOut.heading},
                                 {"kept_from_learning", keptFromLearning(n.heldOut.part)},
                                 {"interrupted", summary.cancelled}}
                      .dump(2)
                      .c_str());
        return;
    }
    std::printf("%s%s: %d inputs, %d hidden units; learned from %lld patterns in %s (%lld epochs)\n", flags.out.c_str(),
                summary.cancelled ? " (interrupted: the best network so far)" : "", n.mlp.shape.inputs,
                n.mlp.shape.hidden, static_cast<long long>(n.training.patterns), durationText(seconds).c_str(),
                static_cast<long long>(n.training.epochs));
    std::printf(
        "held out, %.1f s open loop, %lld windows: position error %.2f %% of the path, heading error %.2f %% of the "
        "rotation\n",
        n.heldOut.horizon, static_cast<long long>(n.heldOut.windows), n.heldOut.position, n.heldOut.heading);
    if (n.heldOut.part.holdsAny())
        std::printf("kept from learning, for mrose evaluate --held-out: %s\n",
                    keptFromLearning(n.heldOut.part).c_str());
}

using Identified = MotionNetwork::Identified;

template <class Value>
double medianOf(const std::vector<Identified>& robots, Value value) {
    std::vector<double> values;
    for (const Identified& robot : robots) values.push_back(value(robot));
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Those identified, median of the robots, unless the command line says otherwise.
ResponseTimes responseTimes(const std::vector<Identified>& robots, const TrainFlags& flags) {
    constexpr double quickest = 0.03;  // s: no drive forgets a push faster, whatever the fit says
    ResponseTimes t;
    t.deadTimeV = flags.deadTimeV.value_or(medianOf(robots, [](const Identified& i) { return i.dynamic.v.deadTime; }));
    t.deadTimeW = flags.deadTimeW.value_or(medianOf(robots, [](const Identified& i) { return i.dynamic.w.deadTime; }));
    t.lagV = flags.lagV.value_or(medianOf(robots, [](const Identified& i) { return i.dynamic.v.lag; }));
    t.lagW = flags.lagW.value_or(medianOf(robots, [](const Identified& i) { return i.dynamic.w.lag; }));
    t.recoveryV =
        flags.lagV.value_or(std::max(quickest, medianOf(robots, [](const Identified& i) { return i.v.lag; })));
    t.recoveryW =
        flags.lagW.value_or(std::max(quickest, medianOf(robots, [](const Identified& i) { return i.w.lag; })));
    return t;
}

/// What is learned from, and what is known of the network beforehand.
struct TrainingData {
    HoldOut holdOut;
    std::vector<Log> logs;  ///< without what is held out
    MotionNetwork blueprint;
};

Expected<TrainingData> trainingData(const LearningLogs& opened, const TrainFlags& flags, const RobotTraits& traits) {
    TrainingData data;
    data.holdOut = opened.holdOut;
    auto logs = opened.learned();
    if (!logs) return tl::unexpected(logs.error());
    data.logs = std::move(*logs);
    auto identified = identifyRobots(data.logs);
    if (!identified) return tl::unexpected(identified.error());
    data.blueprint = recipeOf(flags.model).blueprint(traits, robotNames(data.logs), responseTimes(*identified, flags));
    data.blueprint.identified = std::move(*identified);
    return data;
}

/// With a guard around blocks of time that are held out: what a pattern reads back and the length of a rollout. How far
/// the network reads depends on what is identified, and that on what is held out; so the guard grows until it suffices.
Expected<TrainingData> guardedTrainingData(LearningLogs opened, const RobotTraits& traits, const TrainFlags& flags,
                                           const NetworkTrainerOptions& options) {
    for (;;) {
        auto data = trainingData(opened, flags, traits);
        if (!data || !opened.holdOut.byTime()) return data;
        const int chain = options.loss == LearningLoss::rollout ? options.rolloutLength : 1;
        const double reach = toSeconds(InputReader(data->blueprint).lookBack() + chain * data->blueprint.period);
        if (reach <= opened.holdOut.guard) return data;
        opened.holdOut.guard = std::ceil(10 * reach) / 10;
    }
}

int train(TrainFlags flags, const CommonFlags& common) {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<std::string> read;
    for (const std::string& log : flags.logs) read.push_back(placeOfLog(log));
    if (const auto writable = checkOutput(flags.out, read, common.overwrite); !writable)
        return report(writable.error());
    const HoldOutBy holdOutBy = flags.holdOutBy.empty()       ? HoldOutBy::whatSuits
                                : flags.holdOutBy == "groups" ? HoldOutBy::groups
                                                              : HoldOutBy::time;
    const auto opened = openLearningLogs({flags.logs, flags.robots, flags.holdOut, flags.holdOutPart, holdOutBy});
    if (!opened) return report(opened.error());
    if (!common.quiet && !common.json)
        for (const Log& log : opened->logs)
            for (const std::string& missing : log.incomplete) std::printf("Note: %s\n", missing.c_str());
    const auto traits = traitsOf(flags.type, opened->logs.front());
    if (!traits) return report(traits.error());
    if (flags.model.empty()) flags.model = modelFor(opened->logs);
    const NetworkTrainerOptions options = trainerOptions(flags, common);
    watchInterrupts();

    auto data = guardedTrainingData(*opened, *traits, flags, options);
    if (!data) return report(data.error(), flags.logs.front());
    MotionNetwork& blueprint = data->blueprint;
    SampleOptions sampleOptions;
    sampleOptions.heldOut = data->holdOut;
    sampleOptions.folds = flags.folds;
    sampleOptions.phases = flags.phases > 0 ? flags.phases : recipeOf(flags.model).phases;
    auto samples = motionSamples(data->logs, blueprint, sampleOptions);
    if (!samples) return report(samples.error(), flags.logs.front());
    const std::vector<TrackerOffset> trackers = removeTrackerOffsets(*samples);
    for (std::size_t i = 0; i < trackers.size() && i < blueprint.identified.size(); ++i)
        blueprint.identified[i].tracker = trackers[i];
    blueprint.drive = opened->drive;
    blueprint.heldOut.part = data->holdOut;
    blueprint.synthetic =
        std::any_of(opened->logs.begin(), opened->logs.end(), [](const Log& log) { return log.synthetic; });
    blueprint.training.command = commandLine();
    for (const Log& log : opened->logs)
        for (const LogFile& file : log.files) blueprint.training.logs.push_back({file.path, file.hash});

    TrainingDisplay display(common.quiet);
    const auto summary = trainNetwork(blueprint, *samples, options, std::ref(display));
    if (!summary) return report(summary.error(), flags.logs.front());
    if (const auto saved = saveNetwork(summary->network, flags.out); !saved) return report(saved.error());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    printSummary(*summary, flags, common, spent.count());
    if (summary->cancelled) return interruptedStatus();
    return success;
}

}  // namespace

Subcommand addTrain(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<TrainFlags>();
    const std::string examples =
        "  mrose train MRCLAM_Dataset6 -o create.net\n"
        "  mrose train MRCLAM_Dataset6 --model paper --seed 3 -o create_paper.net\n"
        "  mrose train husky_windows.csv --hold-out 0.2 -o husky.net\n"
        "  mrose train monday.csv tuesday.csv --robots attacker -o attacker.net\n" +
        std::string(modelsText) +
        "Ctrl-C, SIGTERM or SIGHUP ends learning and saves the best network so far; Ctrl-C after that ends the program "
        "at "
        "once.";
    CLI::App* sub = addSubcommand(app, common, "train", "Learn a motion network from logs", examples);
    addSeed(*sub, common);
    addThreads(*sub, common);
    addOverwrite(*sub, common);
    addTrainFlags(*sub, *flags);
    return {sub, [flags, &common] {
                if (const auto fits = checkTogether(*flags); !fits) {
                    report(fits.error());
                    return static_cast<int>(usage);
                }
                return train(*flags, common);
            }};
}

}  // namespace mrose::cli
