#include "identification/advice_trial.h"

#include <algorithm>

#include "identification/familiar_driving.h"
#include "identification/network_trainer.h"
#include "identification/recipes.h"
#include "synthetic/log_generator.h"
#include "world/noise.h"

namespace mrose {
namespace {

const ReferenceRobotParameters robot;
const CommandLimits whole{-robot.largestSpeed, robot.largestSpeed, robot.largestTurn};
constexpr double more = 120;  // s

Trajectory driven(std::vector<StampedCommand> commands, double duration, std::uint64_t seed, int group) {
    Trajectory trajectory;
    trajectory.name = std::to_string(group);
    trajectory.group = group;
    // Issued every 0.1 s, as a controller does.
    std::vector<StampedCommand> issued;
    std::size_t next = 0;
    Command now;
    for (Nanoseconds time = 0; time < fromSeconds(duration); time += 100'000'000) {
        for (; next < commands.size() && commands[next].time <= time; ++next) now = commands[next].command;
        issued.push_back({time, now});
    }
    trajectory.poses = runReferenceRobot(issued, duration, {}, seed).tracked;
    trajectory.commands = std::move(issued);
    return trajectory;
}

Log referenceLog(std::vector<Trajectory> trajectories) {
    Log log;
    log.source = "reference robot";
    log.synthetic = true;
    log.robots.push_back({"reference", std::move(trajectories), {}});
    return log;
}

/// The calm ones of the drivers of mrose generate: those that never back up in a minute.
std::vector<Trajectory> calm(std::uint64_t seed) {
    std::vector<Trajectory> all;
    for (std::uint32_t index = 100; all.size() < 4; ++index) {
        auto commands = patternCommands(DrivePattern::random, 60, seed, index);
        const auto backs = [](const StampedCommand& issued) { return issued.command.v < 0; };
        if (std::any_of(commands.begin(), commands.end(), backs)) continue;
        const auto group = static_cast<int>(all.size());
        all.push_back(driven(std::move(commands), 60, seed * 100 + index, group));
    }
    return all;
}

/// As mrose generate drives at random.
std::vector<Trajectory> generated(std::uint64_t seed) {
    std::vector<Trajectory> all;
    for (int t = 0; t < 2; ++t) {
        auto commands = patternCommands(DrivePattern::random, more / 2, seed, std::uint32_t(t));
        all.push_back(driven(std::move(commands), more / 2, seed * 100 + 50 + std::uint64_t(t), 4 + t));
    }
    return all;
}

/// Commands drawn evenly over the limits, held for 0.4 to 3 s.
std::vector<Trajectory> evenly(std::uint64_t seed) {
    std::vector<Trajectory> all;
    for (int t = 0; t < 2; ++t) {
        std::vector<StampedCommand> commands;
        double time = 0.5;
        for (int i = 0; time < more / 2 - 2; ++i) {
            const UniformDraws draws({seed, i, std::uint32_t(t), 8});
            commands.push_back(
                {fromSeconds(time),
                 {whole.leastV + draws[0] * (whole.mostV - whole.leastV), whole.mostW * (2 * draws[1] - 1)}});
            time += 0.4 + 2.6 * draws[2];
        }
        commands.push_back({fromSeconds(more / 2 - 2), {}});
        all.push_back(driven(std::move(commands), more / 2, seed * 100 + 60 + std::uint64_t(t), 4 + t));
    }
    return all;
}

NetworkTrainerOptions training(std::uint64_t seed, int epochs) {
    NetworkTrainerOptions options;
    options.hidden = 16;
    options.members = 4;
    options.epochs = epochs;
    options.patience = epochs;
    options.evaluateEvery = 20;
    options.rolloutLength = 20;
    options.horizon = 5;
    options.seed = seed;
    return options;
}

MotionNetwork learned(const Log& log, std::uint64_t seed, int epochs) {
    MotionNetwork blueprint = stateBlueprint(RobotTraits(), {"reference"}, {0.32, 0.2, 0.32, 0.15, 0.2, 0.15});
    SampleOptions sampling;
    sampling.phases = 1;
    sampling.folds = 4;
    auto samples = motionSamples({&log, 1}, blueprint, sampling);
    removeTrackerOffsets(*samples);
    auto trained = trainNetwork(blueprint, *samples, training(seed, epochs));
    trained->network.familiar = familiarDriving({&log, 1}, blueprint, sampling);
    return std::move(trained->network);
}

/// P of 10 s open loop over drives at random, and Hd, %.
OpenLoopError errorOf(const MotionNetwork& network, const Log& heldOut) {
    SampleOptions sampling;
    sampling.phases = 1;
    sampling.folds = 1;
    auto samples = motionSamples({&heldOut, 1}, network, sampling);
    removeTrackerOffsets(*samples);
    const auto from = [](const SampleRun&) { return std::size_t{0}; };
    const RolloutBatch batch(*samples, network, chainStarts(*samples, 100, 20, from), 100);
    const MlpGradient engine(network.mlp.shape);
    return openLoopError(batch, batch.predict(engine, network.mlp.parameters), samples->period);
}

Log joined(std::vector<Trajectory> first, const std::vector<Trajectory>& then) {
    first.insert(first.end(), then.begin(), then.end());
    return referenceLog(std::move(first));
}

/// A drive in two halves, as the others come.
std::vector<Trajectory> halves(const Trajectory& drive) {
    std::vector<Trajectory> parts;
    for (int half = 0; half < 2; ++half) {
        Trajectory part = drive;
        part.name = std::to_string(4 + half);
        part.group = 4 + half;
        const auto isOther = [&](const auto& stamped) {
            return (stamped.time >= fromSeconds(more / 2)) != (half == 1);
        };
        std::erase_if(part.commands, isOther);
        std::erase_if(part.poses, isOther);
        parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace

AdviceTrial adviceTrial(std::uint64_t seed, int epochs, const Log& heldOut, bool evenToo) {
    const std::vector<Trajectory> base = calm(seed);
    const Log baseLog = referenceLog(base);
    const MotionNetwork before = learned(baseLog, seed, epochs);
    const LearnedMotion motion(before);
    AdviceOptions options;
    options.limits = whole;
    options.duration = more;
    options.seed = seed;
    AdviceTrial trial;
    trial.advice = adviseDrive(motion, {&baseLog, 1}, options).value();
    const auto errorWith = [&](const std::vector<Trajectory>& added) {
        return errorOf(learned(joined(base, added), seed, epochs), heldOut);
    };
    trial.before = errorOf(before, heldOut);
    trial.advised = errorWith(halves(driven(trial.advice.commands, more, seed * 100 + 40, 4)));
    trial.random = errorWith(generated(seed));
    if (evenToo) trial.even = errorWith(evenly(seed));
    return trial;
}

}  // namespace mrose
