#include "diagnosis/planted_logs.h"

#include <cmath>
#include <numbers>

#include "assessment/played_scenarios.h"
#include "behaviour/command_player.h"
#include "logs/conditioning.h"
#include "motion/kinematic.h"
#include "simulation/step.h"
#include "support/scenes.h"
#include "support/units.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr Nanoseconds tick = 20 * ms, logBegin = 10 * second, duration = 11 * second;
constexpr Nanoseconds rolloutStart = 2500 * ms;
constexpr MotionNoise quiet{0.003, 0.003, 0}, loud{0.1, 0.06, 0.05};

/// Draws of one planted log.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}
    double between(double low, double high) { return low + (high - low) * uniformNoise({seed_, next_++, 0, 0}); }
    double normal() { return normalNoise({seed_, next_++, 0, 0}); }
    double sign() { return between(-1, 1) < 0 ? -1 : 1; }

private:
    std::uint64_t seed_;
    std::int64_t next_ = 0;
};

KinematicParameters usual() {
    KinematicParameters parameters;
    parameters.v = {0.12, 0.2, 1, 0, 0, 0};
    parameters.w = {0.12, 0.3, 1, 0, 0, 0};
    return parameters;
}

std::shared_ptr<const MotionModel> modelOf(const KinematicParameters& parameters) {
    return std::make_shared<const KinematicModel>(parameters, 100 * ms);
}

/// About ten commands a second, that change every so often, but not in the time before the rollout: a velocity that is
/// measured while it changes is another thing that is wrong.
std::vector<StampedCommand> randomCommands(Dice& dice) {
    std::vector<StampedCommand> commands;
    Command inForce;
    Nanoseconds change = 0;
    for (Nanoseconds t = 0; t < duration; t += 100 * ms) {
        const bool before = t > rolloutStart - 1500 * ms && t < rolloutStart + 200 * ms;
        if (t >= change && !before) {
            inForce = {dice.between(0.3, 1), dice.between(-2, 2)};
            change = t + fromSeconds(dice.between(0.5, 1.1));
        }
        commands.push_back({t + fromSeconds(dice.between(0, 0.02)), inForce});
    }
    commands.front().time = 0;
    return commands;
}

ScenarioParts emptyWorld(std::shared_ptr<const MotionModel> model, const MotionNoise& noise) {
    ScenarioParts parts;
    parts.name = "planted";
    parts.scene.tickLength = tick;
    parts.scene.robotTypes.push_back(discRobot(0.17, 4.5));
    parts.scene.models = {withNoise(std::move(model), noise)};
    parts.scene.robots.push_back({"simulated", 0, 0, 0, {1, 2, 0.5}});
    parts.controllers.push_back(std::make_shared<CommandPlayer>(std::vector<StampedCommand>()));
    return parts;
}

/// Where the robot is at each tick.
std::vector<StampedPose> driven(std::shared_ptr<const MotionModel> model, const MotionNoise& noise,
                                const std::vector<StampedCommand>& commands, std::uint64_t seed) {
    ScenarioParts parts = emptyWorld(std::move(model), noise);
    parts.controllers[0] = std::make_shared<CommandPlayer>(commands);
    const Scenario scenario(std::move(parts));
    WorldState state = scenario.initialState(seed);
    StepBuffers buffers;
    std::vector<StampedPose> poses{{0, state.robots[0].pose}};
    for (Nanoseconds t = tick; t < duration; t += tick) {
        step(scenario, state, buffers);
        poses.push_back({t, state.robots[0].pose});
    }
    return poses;
}

/// From `time` on the robot is elsewhere, by `displacement` in its own frame: nothing that moves it depends on where
/// it is.
void displace(std::vector<StampedPose>& poses, Nanoseconds time, const Pose& displacement) {
    const auto at = std::size_t(time / tick);
    const Pose from = poses[at].pose;
    for (std::size_t i = at; i < poses.size(); ++i) poses[i].pose = from * displacement * relative(from, poses[i].pose);
}

void track(std::vector<StampedPose>& poses, Dice& dice) {
    for (StampedPose& stamped : poses) {
        stamped.pose.x += 1e-3 * dice.normal();
        stamped.pose.y += 1e-3 * dice.normal();
        stamped.pose.heading += 1e-3 * dice.normal();
    }
}

template <class Sample>
void forget(std::vector<Sample>& samples, Nanoseconds from, Nanoseconds to) {
    std::erase_if(samples, [&](const Sample& sample) { return sample.time > from && sample.time < to; });
}

/// A single zero command shortly before one that repeats the one in force, some time after `from`. Its time.
Nanoseconds insertBlip(std::vector<StampedCommand>& commands, Nanoseconds from, Dice& dice) {
    for (std::size_t i = 1; i < commands.size(); ++i) {
        if (commands[i].time < from || !(commands[i].command == commands[i - 1].command)) continue;
        const Nanoseconds time = commands[i].time - fromSeconds(dice.between(0.035, 0.04));
        commands.insert(commands.begin() + static_cast<std::ptrdiff_t>(i), {time, {}});
        return time;
    }
    return 0;
}

/// Of sorted commands: `command` from `from` on, and none of the others before `to`, where the one of then is in force.
void hold(std::vector<StampedCommand>& commands, const Command& command, Nanoseconds from, Nanoseconds to) {
    Command after = command;
    for (const StampedCommand& told : commands)
        if (told.time <= to) after = told.command;
    std::erase_if(commands, [&](const StampedCommand& told) { return told.time >= from && told.time <= to; });
    const auto here =
        std::find_if(commands.begin(), commands.end(), [&](const StampedCommand& told) { return told.time > to; });
    commands.insert(here, {{from, command}, {to, after}});
}

/// The first command after `from` that differs from the one before acts later or sooner.
void shiftChange(std::vector<StampedCommand>& commands, Nanoseconds from, Dice& dice) {
    const Nanoseconds shift = fromSeconds(dice.between(0.12, 0.28));
    for (std::size_t i = 1; i < commands.size(); ++i) {
        const Command before = commands[i - 1].command, command = commands[i].command;
        const Nanoseconds time = commands[i].time;
        if (time < from || command == before) continue;
        if (dice.sign() > 0)
            hold(commands, before, time, time + shift);
        else
            hold(commands, command, time - shift, time);
        return;
    }
}

/// As a reader gives it.
Log madeUpLog(std::vector<StampedCommand> commands, std::vector<StampedPose> poses) {
    Trajectory trajectory;
    trajectory.name = std::string{"whole"};
    trajectory.commands = std::move(commands);
    trajectory.poses = std::move(poses);
    for (StampedCommand& command : trajectory.commands) command.time += logBegin;
    for (StampedPose& pose : trajectory.poses) pose.time += logBegin;
    RobotLog robot{std::string{"r"}, {}, {}};
    conditionCommands(trajectory.commands, {}, robot.defects, &trajectory.blips);
    conditionPoses(trajectory.poses, {}, robot.defects);
    robot.trajectories.push_back(std::move(trajectory));
    return {"made-up", "csv", 0, {std::move(robot)}, {}, true};
}

Obstacle postAt(const Pose& pose) {
    ShapePart part;
    part.radius = 0.1;
    part.centre = {pose.x, pose.y};
    return {"post", Shape::fromParts("post", {part}), {0.3, 0.1}};
}

}  // namespace

const char* name(Planted planted) {
    constexpr const char* names[] = {"longer dead time",
                                     "shorter dead time",
                                     "start velocity",
                                     "contact",
                                     "other model",
                                     "noise",
                                     "blip",
                                     "held blip",
                                     "single command",
                                     "gap of commands",
                                     "gap of truth",
                                     "jump of truth",
                                     "larger wheels",
                                     "push",
                                     "wrong pose",
                                     "scaled commands"};
    return names[static_cast<int>(planted)];
}

std::optional<CauseKind> causeOf(Planted planted) {
    constexpr CauseKind causes[] = {CauseKind::deadTime,  CauseKind::deadTime,   CauseKind::startVelocity,
                                    CauseKind::contact,   CauseKind::otherModel, CauseKind::noise,
                                    CauseKind::logDefect, CauseKind::logDefect,  CauseKind::command,
                                    CauseKind::logDefect, CauseKind::logDefect,  CauseKind::logDefect};
    if (planted > Planted::truthJump) return std::nullopt;
    return causes[static_cast<int>(planted)];
}

PlantedLog plantedLog(Planted planted, std::uint64_t number) {
    Dice dice(number * plantedKinds + static_cast<std::uint64_t>(planted));
    PlantedLog made;
    made.bound.constant = {0.03, 3 * std::numbers::pi / 180};
    made.request = {0, rolloutStart, 70};
    KinematicParameters real = usual(), other = usual(), sluggish = usual();
    const double turned = dice.sign();
    other.v.gain = 1 - 0.12 * turned;
    other.w.gain = 1 + 0.12 * turned;
    sluggish.v.lag = sluggish.w.lag = 0.6;
    MotionNoise noise = quiet;
    std::vector<StampedCommand> told = randomCommands(dice), logged = told;
    const Nanoseconds when = rolloutStart + fromSeconds(dice.between(0.5, 3.5));
    const Pose hit{dice.between(-0.03, 0.03), 0.04 * dice.sign(), 0.08 * dice.sign()};
    switch (planted) {
        case Planted::longerDeadTime:
            real.v.deadTime = real.w.deadTime = 0.14;
            break;
        case Planted::shorterDeadTime:
            real.v.deadTime = real.w.deadTime = 0.1;
            break;
        case Planted::otherModel:
            real = other;
            break;
        case Planted::noise:
            noise = loud;
            break;
        case Planted::blip:
            insertBlip(told, when, dice);
            logged = told;
            break;
        case Planted::heldBlip: {
            const Nanoseconds blip = insertBlip(logged, when, dice);
            told = logged;
            hold(told, {}, blip, blip + fromSeconds(dice.between(0.15, 0.28)));
            break;
        }
        case Planted::singleCommand:
            shiftChange(told, when, dice);
            break;
        case Planted::commandGap:
            forget(logged, when, when + fromSeconds(dice.between(0.7, 1.2)));
            break;
        case Planted::largerWheels:
            real.v.gain = real.w.gain = 1.15;
            break;
        case Planted::scaledCommands:
            for (StampedCommand& command : told) command.command.w *= 0.8;
            break;
        default:
            break;
    }
    std::vector<StampedPose> poses = driven(modelOf(real), noise, told, number);
    if (planted == Planted::startVelocity) {
        const Pose turn{0, 0, 0.04 * dice.sign()};
        for (int k = 5; k < 8; ++k) displace(poses, rolloutStart - k * tick, turn);
    }
    if (planted == Planted::push || planted == Planted::truthGap) displace(poses, when, hit);
    if (planted == Planted::truthJump)
        displace(poses, when,
                 {dice.between(0.15, 0.4) * dice.sign(), dice.between(0.15, 0.4) * dice.sign(), hit.heading});
    std::vector<StampedPose> tracked = poses;
    track(tracked, dice);
    if (planted == Planted::truthGap)
        forget(tracked, when - fromSeconds(dice.between(0.05, 0.3)), when + fromSeconds(dice.between(0.2, 0.4)));
    if (planted == Planted::wrongPose)
        for (StampedPose& stamped : tracked)
            if (stamped.time <= rolloutStart) stamped.pose = stamped.pose * hit;

    made.parts = emptyWorld(modelOf(usual()), noise);
    made.parts.players.push_back({0, {"planted", "planted", "r", "", 0}});
    if (planted == Planted::contact)
        made.parts.scene.environment.obstacles.push_back(
            postAt(poses[std::size_t((when + 1200 * ms) / tick)].pose * Pose{0, dice.between(-0.12, 0.12), 0}));
    made.models = {{"sluggish", {modelOf(sluggish)}},
                   {"other", {modelOf(other)}},
                   {"velocity = command", {modelOf(KinematicParameters{})}}};
    made.log = madeUpLog(std::move(logged), std::move(tracked));
    return made;
}

}  // namespace mrose
