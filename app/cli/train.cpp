#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "common.h"
#include "evaluation/format.h"
#include "identification/network_trainer.h"
#include "identification/recipes.h"
#include "identification/robot_identification.h"
#include "io/file.h"
#include "learning_logs.h"

namespace mrose::cli {
namespace {

struct TrainFlags {
    std::vector<std::string> logs, robots;
    std::string out, model, type, method = "irprop+", loss;
    int hidden = 0, members = 0, epochs = 0, patience = 0, phases = 0, chain = 0, folds = 4, holdOutPart = 0;
    double holdOut = 0;
    std::optional<double> deadTimeV, deadTimeW, lagV, lagW;
};

const std::map<std::string, LearningMethod> methods{{"irprop+", LearningMethod::irpropPlus},
                                                    {"irprop-", LearningMethod::irpropMinus},
                                                    {"rprop+", LearningMethod::rpropPlus},
                                                    {"rprop-", LearningMethod::rpropMinus},
                                                    {"lm", LearningMethod::levenbergMarquardt}};

std::string robotTypeOf(const Log& log) {
    const std::string kind = robotKind(log);
    return kind.empty() ? "robot" : kind;
}

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

/// What a kind of network reads, and what its training defaults to.
struct Recipe {
    MotionNetwork (*blueprint)(const RobotTraits&, std::vector<std::string>, const ResponseTimes&);
    LearningLoss loss;
    int hidden, members, epochs, patience;
    int phases;  ///< of the period at which the logs are read
    int chain;   ///< periods
    double velocityWeight = RolloutLoss{}.velocityWeight;
};
const std::map<std::string, Recipe> recipes{
    {"history", {historyBlueprint, LearningLoss::rollout, 32, 4, 1000, 300, 5, 20}},
    {"state", {stateBlueprint, LearningLoss::rollout, 24, 1, 4000, 4000, 1, 20}},
    {"velocity", {velocityBlueprint, LearningLoss::rollout, 32, 8, 1000, 300, 5, 10, 0.3}},
    {"paper", {paperBlueprint, LearningLoss::oneStep, 40, 1, 2000, 300, 5, 20}}};

LearningLoss lossOf(const TrainFlags& flags) {
    if (flags.loss.empty()) return recipes.at(flags.model).loss;
    return flags.loss == "rollout" ? LearningLoss::rollout : LearningLoss::oneStep;
}

TrainerOptions trainerOptions(const TrainFlags& flags, const CommonFlags& common) {
    const Recipe& recipe = recipes.at(flags.model);
    const auto given = [](int flag, int otherwise) { return flag > 0 ? flag : otherwise; };
    TrainerOptions options;
    options.method = methods.at(flags.method);
    options.loss = lossOf(flags);
    options.hidden = given(flags.hidden, recipe.hidden);
    options.members = given(flags.members, recipe.members);
    options.epochs = given(flags.epochs, recipe.epochs);
    options.patience = given(flags.patience, recipe.patience);
    options.rolloutLength = given(flags.chain, recipe.chain);
    options.rolloutLoss.velocityWeight = recipe.velocityWeight;
    options.seed = common.seed;
    return options;
}

/// Shows how learning goes, and how long it still takes at most.
class TrainingDisplay {
public:
    explicit TrainingDisplay(bool quiet) : line_(quiet) {}

    bool operator()(const TrainingProgress& p) {
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

void printSummary(const TrainingSummary& summary, const TrainFlags& flags, const CommonFlags& common, double seconds) {
    const MotionNetwork& n = summary.network;
    if (common.json) {
        std::puts(nlohmann::json{{"network", flags.out},
                                 {"patterns", n.training.patterns},
                                 {"epochs", n.training.epochs},
                                 {"seconds", seconds},
                                 {"held_out_windows", n.heldOut.windows},
                                 {"held_out_position_percent", n.heldOut.position},
                                 {"held_out_heading_percent", n.heldOut.heading},
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

int train(TrainFlags flags, const CommonFlags& common) {
    const auto begin = std::chrono::steady_clock::now();
    if (const auto writable = checkWritable(flags.out); !writable) return report(writable.error());
    const GroupHoldOut holdOut = holdOutShare(flags.holdOut, flags.holdOutPart);
    const auto opened = openLearningLogs({flags.logs, flags.robots, holdOut});
    if (!opened) return report(opened.error());
    const std::vector<Log>& logs = opened->logs;
    if (flags.model.empty()) flags.model = modelFor(logs);
    watchInterrupts();

    const auto identified = identifyRobots(logs);
    if (!identified) return report(identified.error(), flags.logs.front());
    const RobotTraits traits = robotTraits(flags.type.empty() ? robotTypeOf(logs.front()) : flags.type);
    MotionNetwork blueprint =
        recipes.at(flags.model).blueprint(traits, robotNames(logs), responseTimes(*identified, flags));
    SampleOptions sampleOptions;
    sampleOptions.heldOut = holdOut;
    sampleOptions.folds = flags.folds;
    sampleOptions.phases = flags.phases > 0 ? flags.phases : recipes.at(flags.model).phases;
    auto samples = motionSamples(logs, blueprint, sampleOptions);
    if (!samples) return report(samples.error(), flags.logs.front());
    blueprint.identified = *identified;
    const std::vector<TrackerOffset> trackers = removeTrackerOffsets(*samples);
    for (std::size_t i = 0; i < trackers.size() && i < blueprint.identified.size(); ++i)
        blueprint.identified[i].tracker = trackers[i];
    blueprint.drive = opened->drive;
    blueprint.heldOut.groups = holdOut;
    blueprint.synthetic = std::any_of(logs.begin(), logs.end(), [](const Log& log) { return log.synthetic; });
    blueprint.training.command = commandLine();
    for (const Log& log : logs)
        for (const LogFile& file : log.files) blueprint.training.logs.push_back({file.path, file.hash});

    TrainingDisplay display(common.quiet);
    const auto summary = trainNetwork(blueprint, *samples, trainerOptions(flags, common), std::ref(display));
    if (!summary) return report(summary.error(), flags.logs.front());
    if (const auto saved = saveNetwork(summary->network, flags.out); !saved) return report(saved.error());
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    printSummary(*summary, flags, common, spent.count());
    return summary->cancelled ? interrupted : success;
}

}  // namespace

Subcommand addTrain(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<TrainFlags>();
    CLI::App* sub =
        addSubcommand(app, common, "train", "Learn a motion network from logs",
                      "  mrose train MRCLAM_Dataset6 -o create.net\n"
                      "  mrose train MRCLAM_Dataset6 --model paper --seed 3 -o create_paper.net\n"
                      "  mrose train husky_windows.csv --hold-out 0.2 -o husky.net\n"
                      "  mrose train monday.csv tuesday.csv --robots attacker -o attacker.net\n"
                      "Ctrl-C ends learning and saves the best network so far; a second one ends the program at once.");
    sub->add_option("LOG", flags->logs,
                    "Logs to learn from: MRCLAM folders, Husky windows, CSV files or folders of them")
        ->required();
    sub->add_option("-o,--output", flags->out, "The network file to write")->required();
    sub->add_option(
           "--model", flags->model,
           "history: commands of the last tenths of a second -> motion, learned on rollouts; "
           "state: velocity and commands around the dead time -> motion and velocity, learned on rollouts, for "
           "robots of limited acceleration; "
           "velocity: velocity and commands in coarse bins, for robots that measure their velocity; "
           "paper: (v, w, v_cmd, w_cmd) -> (dx, dy, dphi, v', w'), learned on single steps. "
           "Default: velocity for robots that measure their own, history for others")
        ->check(CLI::IsMember({"history", "state", "velocity", "paper"}));
    sub->add_option("--robots", flags->robots, "Learn from these robots only, by name: 1,2")->delimiter(',');
    sub->add_option("--robot-type", flags->type, "Kind of robot; default: what the log's format tells");
    sub->add_option("--method", flags->method, "Learning method; lm fits single steps only")
        ->check(CLI::IsMember({"irprop+", "irprop-", "rprop+", "rprop-", "lm"}))
        ->capture_default_str();
    sub->add_option("--loss", flags->loss, "What is minimised; default: one-step for paper, else rollout")
        ->check(CLI::IsMember({"one-step", "rollout"}));
    sub->add_option("--chain", flags->chain, "Periods of a rollout that is learned from; default 20, 10 for velocity")
        ->check(CLI::Range(1, 1000));
    sub->add_option("--hidden", flags->hidden, "Hidden units of each member; default: the model's")
        ->check(CLI::Range(1, 1024));
    sub->add_option(
           "--members", flags->members,
           "Networks, each learned with another part of the logs held out, whose mean is saved as one; default 4 "
           "(velocity: 8, state and paper: 1)")
        ->check(CLI::Range(1, 64));
    sub->add_option("--folds", flags->folds, "Parts that the logs are divided into, held out in turn")
        ->check(CLI::Range(2, 64))
        ->capture_default_str();
    sub->add_option("--hold-out", flags->holdOut,
                    "Share of the groups of trajectories that nothing is learned from: mrose evaluate --held-out "
                    "judges by them alone")
        ->check(numberRange(0.001, 0.5));
    sub->add_option("--hold-out-part", flags->holdOutPart, "Which share that is, for cross-validation: 0, 1, ...")
        ->needs("--hold-out")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    sub->add_option("--epochs", flags->epochs, "At most so many epochs; default: the model's")
        ->check(CLI::Range(1, 10'000'000));
    sub->add_option("--patience", flags->patience,
                    "Stop after so many epochs without a better held-out error; default 300, but all for state")
        ->check(CLI::Range(1, 10'000'000));
    sub->add_option(
           "--phases", flags->phases,
           "Phases of the period at which the logs are read: more patterns from the same logs; default 5, 1 for "
           "state")
        ->check(CLI::Range(1, 20));
    sub->add_option("--dead-time-v", flags->deadTimeV, "Dead time of v in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    sub->add_option("--dead-time-w", flags->deadTimeW, "Dead time of w in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    sub->add_option("--lag-v", flags->lagV, "Lag of v in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    sub->add_option("--lag-w", flags->lagW, "Lag of w in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    return {sub, [flags, &common] {
                if (flags->method == "lm" &&
                    (flags->loss == "rollout" || (flags->loss.empty() && flags->model != "paper"))) {
                    report({"", 0, 0, "--method lm", "fits single steps only; it needs --loss one-step"});
                    return static_cast<int>(usage);
                }
                return train(*flags, common);
            }};
}

}  // namespace mrose::cli
