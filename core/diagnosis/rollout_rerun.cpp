#include "diagnosis/rollout_rerun.h"

#include <algorithm>
#include <cmath>

#include "behaviour/command_player.h"
#include "geometry/point.h"
#include "logs/conditioning.h"
#include "logs/pose_grid.h"
#include "simulation/step.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

/// Commands are read this long before a start, and shifted by less than the rest.
constexpr Nanoseconds readBefore = 4 * nanosecondsPerSecond, readAfter = nanosecondsPerSecond;
/// Between bodies that are put out of the way.
constexpr double outOfTheWay = 1e4;  // m

/// What the noise of a real robot does to the velocity that is measured of it, over so long before the start.
void addMeasuredNoise(const MotionNoise& noise, const NoiseKey& key, Nanoseconds period, Velocity& velocity) {
    constexpr double measuredOver = 0.2;  // s
    const double left = std::sqrt(std::min(1.0, toSeconds(period) / measuredOver));
    const NoisePair draw = normalPair(key);
    const double turning = length({noise.rotationPerRotation * velocity.w, noise.rotationPerDistance * velocity.v});
    velocity.v += left * noise.distancePerDistance * velocity.v * draw.first;
    velocity.w += left * turning * draw.second;
}

/// The part of a trajectory's commands that a rollout reads, with the one in force before.
Trajectory commandsAround(const Trajectory& whole, Nanoseconds begin, Nanoseconds end) {
    Trajectory part;
    part.steady = whole.steady;
    const auto& commands = whole.commands;
    const StampedCommand from{begin - readBefore, {}}, to{end + readAfter, {}};
    auto first = std::upper_bound(commands.begin(), commands.end(), from, earlier<StampedCommand>);
    if (first != commands.begin()) --first;
    part.commands.assign(first, std::upper_bound(first, commands.end(), to, earlier<StampedCommand>));
    return part;
}

}  // namespace

RolloutRerun::RolloutRerun(const LogWorld& world, const RolloutRequest& request, const ComparedRollout& rollout,
                           Nanoseconds step, int steps, std::uint64_t seed)
    : world_(world), request_(request), rollout_(rollout), step_(step), steps_(steps), seed_(seed) {}

const MotionModel& RolloutRerun::model() const {
    return world_.parts().scene.modelOf(world_.robots()[rollout_.robot].body);
}

RolloutRerun::Poses RolloutRerun::run(int from, std::uint64_t seed, const Change& change) const {
    LogWorld::OpenedParts opened =
        world_.partsAt(request_.session, request_.start + from * step_, (steps_ - from) * step_);
    const std::size_t body = opened.bodies[rollout_.robot];
    change(opened, body);
    const Scenario scenario(std::move(opened.parts));
    WorldState state = scenario.initialState(seed);
    StepBuffers buffers;
    Poses poses;
    for (int k = from; k < steps_; ++k) {
        for (Nanoseconds passed = 0; passed < step_; passed += tick()) mrose::step(scenario, state, buffers);
        poses.push_back(state.robots[body].pose);
    }
    return poses;
}

/// With the commands of the log after `edit` of a copy of it.
RolloutRerun::Poses RolloutRerun::withCommands(const std::function<void(Trajectory&)>& edit) const {
    return run(0, seed_, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        const Nanoseconds duration = steps_ * step_;
        RolloutStart start = *opened.starts[rollout_.robot];
        Trajectory edited = commandsAround(trajectory(), start.time, start.time + duration);
        edit(edited);
        start.trajectory = &edited;
        LogWorld::play(opened.parts, body, start, duration);
    });
}

RolloutRerun::Poses RolloutRerun::later(Nanoseconds delay) const {
    return withCommands([delay](Trajectory& edited) {
        for (StampedCommand& command : edited.commands) command.time += delay;
    });
}

RolloutRerun::Poses RolloutRerun::obeying(std::span<const StampedCommand> more) const {
    return withCommands([&](Trajectory& edited) {
        edited.commands.insert(edited.commands.end(), more.begin(), more.end());
        LogDefects ignored;
        sortByTime(edited.commands, ignored);
        keepLastOfEqualStamps(edited.commands, ignored);
    });
}

RolloutRerun::Poses RolloutRerun::holding(const Command& command, Nanoseconds from, Nanoseconds to) const {
    return withCommands([&](Trajectory& edited) {
        auto& commands = edited.commands;
        const auto first = std::lower_bound(commands.begin(), commands.end(), StampedCommand{from, {}},
                                            earlier<StampedCommand>),
                   last = std::upper_bound(first, commands.end(), StampedCommand{to, {}}, earlier<StampedCommand>);
        if (last == commands.begin()) return;
        const StampedCommand after{to, std::prev(last)->command};
        const auto here = commands.erase(first, last);
        commands.insert(here, {{from, command}, after});
    });
}

RolloutRerun::Poses RolloutRerun::startingAt(const Velocity& velocity) const {
    return run(0, seed_, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        opened.parts.scene.robots[body].velocity = velocity;
    });
}

RolloutRerun::Poses RolloutRerun::untouched() const {
    return run(0, seed_, [](LogWorld::OpenedParts& opened, std::size_t body) {
        Scene& scene = opened.parts.scene;
        scene.environment.obstacles.clear();
        double away = 0;
        for (std::size_t i = 0; i < scene.robots.size(); ++i) {
            if (i == body) continue;
            scene.robots[i].start.x += away += outOfTheWay;
            opened.parts.controllers[i] = std::make_shared<CommandPlayer>(std::vector<StampedCommand>());
        }
        for (SceneObject& object : scene.objects) object.start.x += away += outOfTheWay;
    });
}

RolloutRerun::Poses RolloutRerun::movedBy(const std::shared_ptr<const MotionModel>& model) const {
    return run(0, seed_, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        Scene& scene = opened.parts.scene;
        RolloutStart start = *opened.starts[rollout_.robot];
        fillVelocities(*model, {&start, 1});
        scene.robots[body].velocity = start.velocity->velocity;
        scene.robots[body].tracked = TrackerHistory(trajectory(), *model).at(start.time);
        const MotionNoise noise = noiseOf(scene.modelOf(body));
        scene.robots[body].model = static_cast<std::uint32_t>(scene.models.size());
        scene.models.push_back(withNoise(model, noise));
    });
}

RolloutRerun::Poses RolloutRerun::noisy(const MotionNoise& noise, std::uint64_t seed) const {
    return run(0, seed, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        Scene& scene = opened.parts.scene;
        addMeasuredNoise(noise, {seed, -1, static_cast<std::uint32_t>(body), channelOf(NoiseChannel::motion)},
                         scene.modelOf(body).period(), scene.robots[body].velocity);
        auto model = withNoise(scene.models[scene.robots[body].model], noise);
        scene.robots[body].model = static_cast<std::uint32_t>(scene.models.size());
        scene.models.push_back(std::move(model));
    });
}

RolloutRerun::Poses RolloutRerun::carried(int from, int to) const {
    const auto index = [](int k) { return static_cast<std::size_t>(k); };
    const std::vector<Pose>& truth = rollout_.real.truth;
    const Pose before = from == 0 ? rollout_.real.measuredPose : rollout_.simulated[index(from) - 1];
    const Pose real = std::isfinite(truth[index(from)].x) ? truth[index(from)] : before;
    const auto carriedTo = [&](int k) { return before * relative(real, truth[index(k)]); };
    Poses poses(rollout_.simulated.begin(), rollout_.simulated.begin() + from);
    for (int k = from + 1; k <= to; ++k) poses.push_back(carriedTo(k));
    const Poses after = run(to, seed_, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        SceneRobot& robot = opened.parts.scene.robots[body];
        robot.start = carriedTo(to);
        if (const auto velocity = velocityAt(trajectory().poses, rollout_.real.start + to * step_))
            robot.velocity = *velocity;
    });
    poses.insert(poses.end(), after.begin(), after.end());
    return poses;
}

}  // namespace mrose
