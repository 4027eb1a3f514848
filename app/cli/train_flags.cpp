#include "train_flags.h"

#include <algorithm>
#include <map>

namespace mrose::cli {
namespace {

TrainingMethod methodOf(const TrainFlags& flags) {
    const auto found = std::find(trainingMethodNames.begin(), trainingMethodNames.end(), flags.method);
    return static_cast<TrainingMethod>(found - trainingMethodNames.begin());
}

const std::map<std::string, Recipe> recipes{
    {"history", {historyBlueprint, LearningLoss::rollout, 32, 4, 1000, 300, 5, 20}},
    {"state", {stateBlueprint, LearningLoss::rollout, 24, 1, 4000, 4000, 1, 20}},
    {"velocity", {velocityBlueprint, LearningLoss::rollout, 32, 8, 1000, 300, 5, 10, 0.3}},
    {"paper", {paperBlueprint, LearningLoss::oneStep, 40, 1, 2000, 300, 5, 20}}};

LearningLoss lossOf(const TrainFlags& flags) {
    if (flags.loss.empty()) return recipeOf(flags.model).loss;
    return flags.loss == "rollout" ? LearningLoss::rollout : LearningLoss::oneStep;
}

void addWhat(CLI::App& sub, TrainFlags& flags) {
    sub.add_option("LOG", flags.logs, "Logs to learn from: MRCLAM folders, Husky windows, CSV files or folders of them")
        ->required();
    sub.add_option("-o,--output", flags.out, "The network file to write")->required()->check(someName());
    sub.add_option(
           "--model", flags.model,
           "What the network reads: see below. Default: velocity for robots that measure their own, history for "
           "others")
        ->check(CLI::IsMember({"history", "state", "velocity", "paper"}));
    sub.add_option("--robots", flags.robots, "Learn from these robots only, by name: 1,2")->delimiter(',');
    sub.add_option("--type,--robot-type", flags.type,
                   "Kind of robot, whose traits learning must know: its name, as irobot-create, or a robot file with "
                   "[kind]; default: what the log says");
    sub.add_option("--hold-out", flags.holdOut,
                   "Share of the logs that nothing is learned from: mrose evaluate --held-out judges by it alone")
        ->check(numberRange(0.001, 0.5));
    sub.add_option("--hold-out-by", flags.holdOutBy,
                   "Held out are whole groups of trajectories, or blocks of time of long ones, with a guard before and "
                   "after them as long as what the model reads back and a rollout; default: groups where each log has "
                   "enough of them, else time")
        ->check(CLI::IsMember({"groups", "time"}))
        ->needs("--hold-out");
    sub.add_option("--hold-out-part", flags.holdOutPart, "Which share that is, for cross-validation: 0, 1, ...")
        ->needs("--hold-out")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
}

void addHow(CLI::App& sub, TrainFlags& flags) {
    sub.add_option("--method", flags.method, "Learning method; lm fits single steps only")
        ->check(CLI::IsMember(std::vector<std::string>(trainingMethodNames.begin(), trainingMethodNames.end())))
        ->capture_default_str();
    sub.add_option("--loss", flags.loss, "What is minimised; default: one-step for paper, else rollout")
        ->check(CLI::IsMember({"one-step", "rollout"}));
    sub.add_option("--chain", flags.chain, "Periods of a rollout that is learned from; default 20, 10 for velocity")
        ->check(CLI::Range(1, 1000));
    sub.add_option("--hidden", flags.hidden, "Hidden units of each member; default: the model's")
        ->check(CLI::Range(1, 1024));
    sub.add_option(
           "--members", flags.members,
           "Networks, each learned with another part of the logs held out, whose mean is saved as one; default 4 "
           "(velocity: 8, state and paper: 1)")
        ->check(CLI::Range(1, 64));
    sub.add_option("--folds", flags.folds, "Parts that the logs are divided into, held out in turn")
        ->check(CLI::Range(2, 64))
        ->capture_default_str();
    sub.add_option("--epochs", flags.epochs, "At most so many epochs; default: the model's")
        ->check(CLI::Range(1, 10'000'000));
    sub.add_option("--patience", flags.patience,
                   "Stop after so many epochs without a better held-out error; default 300, but all for state")
        ->check(CLI::Range(1, 10'000'000));
    sub.add_option(
           "--phases", flags.phases,
           "Phases of the period at which the logs are read: more patterns from the same logs; default 5, 1 for "
           "state")
        ->check(CLI::Range(1, 20));
}

/// Instead of what is identified from the logs.
void addResponseTimes(CLI::App& sub, TrainFlags& flags) {
    sub.add_option("--dead-time-v", flags.deadTimeV, "Dead time of v in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    sub.add_option("--dead-time-w", flags.deadTimeW, "Dead time of w in s, instead of the one identified")
        ->check(numberRange(0.0, 2.0));
    sub.add_option("--lag-v", flags.lagV, "Lag of v in s, instead of the one identified")->check(numberRange(0.0, 2.0));
    sub.add_option("--lag-w", flags.lagW, "Lag of w in s, instead of the one identified")->check(numberRange(0.0, 2.0));
}

}  // namespace

const char* const modelsText =
    "Models:\n"
    "  history: commands of the last tenths of a second -> motion; learned on rollouts\n"
    "  state: velocity, and commands around the dead time -> motion and velocity; learned on rollouts, for robots of\n"
    "    limited acceleration\n"
    "  velocity: velocity, and commands in coarse bins -> motion and velocity; learned on rollouts, for robots that\n"
    "    measure their velocity\n"
    "  paper: (v, w, v_cmd, w_cmd) -> (dx, dy, dphi, v', w'); learned on single steps\n";

void addTrainFlags(CLI::App& sub, TrainFlags& flags) {
    addWhat(sub, flags);
    addHow(sub, flags);
    addResponseTimes(sub, flags);
}

const Recipe& recipeOf(const std::string& model) { return recipes.at(model); }

NetworkTrainerOptions trainerOptions(const TrainFlags& flags, const CommonFlags& common) {
    const Recipe& recipe = recipeOf(flags.model);
    const auto given = [](int flag, int otherwise) { return flag > 0 ? flag : otherwise; };
    NetworkTrainerOptions options;
    options.method = methodOf(flags);
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

Expected<void> checkTogether(const TrainFlags& flags) {
    const bool rollouts = flags.loss == "rollout" || (flags.loss.empty() && flags.model != "paper");
    if (flags.method == "lm" && rollouts)
        return fail({}, "fits single steps only; it needs --loss one-step", 0, "--method lm");
    return {};
}

}  // namespace mrose::cli
