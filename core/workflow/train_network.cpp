#include "workflow/train_network.h"

#include <algorithm>
#include <cmath>

#include "identification/actuator_limits_fit.h"
#include "identification/familiar_driving.h"
#include "identification/learn_noise.h"
#include "identification/recipes.h"
#include "identification/robot_identification.h"
#include "io/format.h"
#include "workflow/outputs.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

/// What a network reads, and what its training defaults to.
struct Recipe {
    MotionNetwork (*blueprint)(const RobotTraits&, std::vector<std::string>, const ResponseTimes&);
    LearningLoss loss;
    int hidden, members, epochs, patience;
    int phases;  ///< of the period at which the logs are read
    int chain;   ///< periods
    double velocityWeight = RolloutLoss{}.velocityWeight;
    bool linearStart = false;
    bool limited = false;  ///< reads commands as the drive's limits let it follow them
};

const Recipe& recipeOf(NetworkRecipe recipe) {
    static const std::array<Recipe, networkRecipeNames.size()> recipes{
        {{historyBlueprint, LearningLoss::rollout, 32, 4, 1000, 300, 5, 20},
         {stateBlueprint, LearningLoss::rollout, 32, 1, 5000, 5000, 1, 40, RolloutLoss{}.velocityWeight, true, true},
         {velocityBlueprint, LearningLoss::rollout, 32, 8, 1000, 300, 5, 10, 0.3},
         {paperBlueprint, LearningLoss::oneStep, 40, 1, 2000, 300, 5, 20}}};
    return recipes[static_cast<std::size_t>(recipe)];
}

int givenOr(int given, int otherwise) { return given > 0 ? given : otherwise; }

NetworkTrainerOptions trainerOptions(const TrainRequest& request, const Recipe& recipe) {
    NetworkTrainerOptions options;
    options.method = request.method;
    options.loss = request.loss.value_or(recipe.loss);
    options.hidden = givenOr(request.hidden, recipe.hidden);
    options.members = givenOr(request.members, recipe.members);
    options.epochs = givenOr(request.epochs, recipe.epochs);
    options.patience = givenOr(request.patience, recipe.patience);
    options.rolloutLength = givenOr(request.chain, recipe.chain);
    options.rolloutLoss.velocityWeight = recipe.velocityWeight;
    options.seed = request.seed;
    options.linearStart = recipe.linearStart;
    return options;
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
NetworkRecipe recipeFor(const std::vector<Log>& logs) {
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                if (trajectory.measuredVelocity.empty()) return NetworkRecipe::history;
    return NetworkRecipe::velocity;
}

using Identified = MotionNetwork::Identified;

template <class Value>
double medianOf(const std::vector<Identified>& robots, Value value) {
    std::vector<double> values;
    for (const Identified& robot : robots) values.push_back(value(robot));
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Those identified, median of the robots, unless the request says otherwise.
ResponseTimes responseTimes(const std::vector<Identified>& robots, const TrainRequest& request) {
    constexpr double quickest = 0.03;  // s: no drive forgets a push faster, whatever the fit says
    ResponseTimes t;
    t.deadTimeV =
        request.deadTimeV.value_or(medianOf(robots, [](const Identified& i) { return i.dynamic.v.deadTime; }));
    t.deadTimeW =
        request.deadTimeW.value_or(medianOf(robots, [](const Identified& i) { return i.dynamic.w.deadTime; }));
    t.lagV = request.lagV.value_or(medianOf(robots, [](const Identified& i) { return i.dynamic.v.lag; }));
    t.lagW = request.lagW.value_or(medianOf(robots, [](const Identified& i) { return i.dynamic.w.lag; }));
    t.recoveryV =
        request.lagV.value_or(std::max(quickest, medianOf(robots, [](const Identified& i) { return i.v.lag; })));
    t.recoveryW =
        request.lagW.value_or(std::max(quickest, medianOf(robots, [](const Identified& i) { return i.w.lag; })));
    return t;
}

/// What is learned from, and what is known of the network beforehand.
struct TrainingData {
    HoldOut holdOut;
    std::vector<Log> logs;  ///< without what is held out
    MotionNetwork blueprint;
};

Expected<TrainingData> trainingData(const LearningLogs& opened, const TrainRequest& request, const Recipe& recipe,
                                    const RobotTraits& traits) {
    TrainingData data;
    data.holdOut = opened.holdOut;
    auto logs = opened.learned();
    if (!logs) return tl::unexpected(logs.error());
    data.logs = std::move(*logs);
    auto identified = identifyRobots(data.logs);
    if (!identified) return tl::unexpected(identified.error());
    ResponseTimes times = responseTimes(*identified, request);
    const auto blueprint = [&] { return recipe.blueprint(traits, robotNames(data.logs), times); };
    if (recipe.limited) times.limits = identifyActuatorLimits(data.logs, blueprint());
    data.blueprint = blueprint();
    data.blueprint.identified = std::move(*identified);
    return data;
}

/// With a guard around blocks of time that are held out: what a pattern reads back and the length of a rollout. How far
/// the network reads depends on what is identified, and that on what is held out; so the guard grows until it suffices.
Expected<TrainingData> guardedTrainingData(LearningLogs opened, const TrainRequest& request, const Recipe& recipe,
                                           const RobotTraits& traits, const NetworkTrainerOptions& options) {
    for (;;) {
        auto data = trainingData(opened, request, recipe, traits);
        if (!data || !opened.holdOut.byTime()) return data;
        const int chain = options.loss == LearningLoss::rollout ? options.rolloutLength : 1;
        const double reach = toSeconds(InputReader(data->blueprint).lookBack() + chain * data->blueprint.period);
        if (reach <= opened.holdOut.guard) return data;
        opened.holdOut.guard = std::ceil(10 * reach) / 10;
    }
}

/// What the network's file says of where it comes from.
void addOrigin(MotionNetwork& network, const LearningLogs& opened, const TrainRequest& request) {
    network.drive = opened.drive;
    network.training.command = request.command;
    for (const Log& log : opened.logs) {
        network.synthetic = network.synthetic || log.synthetic;
        for (const LogFile& file : log.files) network.training.logs.push_back({file.path, file.hash});
    }
}

/// Of commands that are the same in all of the logs: nothing can be learned of others.
std::vector<std::string> unchangedOf(const std::vector<Log>& logs) {
    std::vector<Command> all;
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                for (const StampedCommand& issued : trajectory.commands) all.push_back(issued.command);
    std::vector<std::string> notes;
    if (all.empty()) return notes;
    const auto note = [&](double Command::*const part, const char* name, const char* unit) {
        const double first = all.front().*part;
        if (std::ranges::any_of(all, [&](const Command& command) { return command.*part != first; })) return;
        notes.push_back("All commands have " + std::string(name) + " = " + numberText(first) + ' ' + unit +
                        ": how the robot answers to others cannot be learned from them.");
    };
    note(&Command::v, "v", "m/s");
    note(&Command::w, "w", "rad/s");
    return notes;
}

std::vector<std::string> missingOf(const std::vector<Log>& logs) {
    std::vector<std::string> notes = unchangedOf(logs);
    for (const Log& log : logs) notes.insert(notes.end(), log.incomplete.begin(), log.incomplete.end());
    return notes;
}

Expected<TrainedNetwork> learnFrom(const LearningLogs& opened, const TrainRequest& request,
                                   const TrainProgress& progress) {
    const auto traits = traitsOf(request.robotKind, opened.logs.front());
    if (!traits) return tl::unexpected(traits.error());
    const std::string& first = request.logs.sources.front();
    const Recipe& recipe = recipeOf(request.recipe.value_or(recipeFor(opened.logs)));
    const NetworkTrainerOptions options = trainerOptions(request, recipe);
    if (!mayGoOn(progress.prepares, 0)) return fail(first, "was not learned from: cancelled");
    auto data = guardedTrainingData(opened, request, recipe, *traits, options);
    if (!data) return atFile(data.error(), first);
    MotionNetwork& blueprint = data->blueprint;
    SampleOptions sampling;
    sampling.heldOut = data->holdOut;
    sampling.folds = request.folds;
    sampling.phases = givenOr(request.phases, recipe.phases);
    if (blueprint.period % sampling.phases != 0)
        return fail({}, "do not divide the control period of " + numberText(toSeconds(blueprint.period)) + " s evenly",
                    0, "--phases " + std::to_string(sampling.phases));
    auto samples = motionSamples(data->logs, blueprint, sampling);
    if (!samples) return atFile(samples.error(), first);
    const std::vector<TrackerOffset> trackers = removeTrackerOffsets(*samples);
    for (std::size_t i = 0; i < trackers.size() && i < blueprint.identified.size(); ++i)
        blueprint.identified[i].tracker = trackers[i];
    blueprint.heldOut.part = data->holdOut;
    addOrigin(blueprint, opened, request);
    if (!mayGoOn(progress.prepares, 1)) return fail(first, "was not learned from: cancelled");
    const bool withNoise = request.noise.value_or(request.recipe != NetworkRecipe::paper);
    const auto learnsAfter = [&](int members) {
        return [&, members](NetworkProgress p) {
            p.member += members;
            p.membersOfNoise = withNoise ? options.members * noiseParts : 0;
            p.members = options.members + p.membersOfNoise;
            return !progress.learns || progress.learns(p);
        };
    };
    auto trained = trainNetwork(blueprint, *samples, options, learnsAfter(0));
    if (!trained) return atFile(trained.error(), first);
    trained->network.familiar = familiarDriving(data->logs, blueprint, sampling);
    if (!withNoise || trained->cancelled) return trained;
    LearnedNoise learned =
        learnNoise(std::move(data->logs), blueprint, sampling, options, learnsAfter(options.members), progress.fits);
    trained->network.noise = std::move(learned.noise);
    trained->noiseOfKnownRobots = learned.ofKnownRobots;
    trained->withoutNoise = std::move(learned.missing);
    trained->cancelled = learned.cancelled;
    return trained;
}

}  // namespace

Expected<void> checkTogether(const TrainRequest& request) {
    const bool paper = request.recipe == NetworkRecipe::paper;
    const LearningLoss loss = request.loss.value_or(paper ? LearningLoss::oneStep : LearningLoss::rollout);
    if (request.method == TrainingMethod::levenbergMarquardt && loss == LearningLoss::rollout)
        return fail({}, "fits single steps only; it needs --loss one-step", 0, "--method lm");
    return {};
}

Expected<TrainedNetwork> trainNetwork(const TrainRequest& request, const TrainProgress& progress) {
    if (auto fits = checkTogether(request); !fits) return tl::unexpected(fits.error());
    std::vector<std::string> read;
    for (const std::string& log : request.logs.sources) read.push_back(placeOfLog(log));
    if (!request.output.empty())
        if (auto can = checkOutput(request.output, read, request.overwrite); !can) return tl::unexpected(can.error());
    const auto opened = openLearningLogs(request.logs);
    if (!opened) return tl::unexpected(opened.error());
    if (progress.opened) progress.opened(missingOf(opened->logs));
    auto trained = learnFrom(*opened, request, progress);
    if (!trained || request.output.empty()) return trained;
    if (auto saved = saveNetwork(trained->network, request.output); !saved) return tl::unexpected(saved.error());
    return trained;
}

}  // namespace mrose
