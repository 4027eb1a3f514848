#include "comparison/course_rerun.h"

#include <algorithm>
#include <cmath>

#include "behaviour/command_player.h"
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
    const double turning = std::hypot(noise.rotationPerRotation * velocity.w, noise.rotationPerDistance * velocity.v);
    velocity.v += left * noise.distancePerDistance * velocity.v * draw.first;
    velocity.w += left * turning * draw.second;
}

/// The part of a trajectory's commands that a course reads, with the one in force before.
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

CourseRerun::CourseRerun(const LogWorld& world, const CourseRequest& request, const ComparedCourse& course,
                         Nanoseconds step, int steps, std::uint64_t seed)
    : world_(world), request_(request), course_(course), step_(step), steps_(steps), seed_(seed) {}

const MotionModel& CourseRerun::model() const {
    return world_.parts().scene.modelOf(world_.robots()[course_.robot].body);
}

CourseRerun::Poses CourseRerun::run(int from, std::uint64_t seed, const Change& change) const {
    LogWorld::OpenedParts opened =
        world_.partsAt(request_.take, request_.start + from * step_, (steps_ - from) * step_);
    const std::size_t body = opened.bodies[course_.robot];
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

/// Told what the log says after `edit` of a copy of it.
CourseRerun::Poses CourseRerun::toldAlso(const std::function<void(Trajectory&)>& edit) const {
    return run(0, seed_, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        const Nanoseconds duration = steps_ * step_;
        RolloutStart start = *opened.starts[course_.robot];
        Trajectory told = commandsAround(trajectory(), start.time, start.time + duration);
        edit(told);
        start.trajectory = &told;
        opened.parts.controllers[body] = LogWorld::player(start, duration);
        fillVelocities(opened.parts.scene.modelOf(body), {&start, 1});
        opened.parts.scene.robots[body].velocity = *start.velocity;
    });
}

CourseRerun::Poses CourseRerun::later(Nanoseconds delay) const {
    return toldAlso([delay](Trajectory& told) {
        for (StampedCommand& command : told.commands) command.time += delay;
    });
}

CourseRerun::Poses CourseRerun::obeying(std::span<const StampedCommand> more) const {
    return toldAlso([&](Trajectory& told) {
        told.commands.insert(told.commands.end(), more.begin(), more.end());
        LogDefects ignored;
        sortByTime(told.commands, ignored);
        keepLastOfEqualStamps(told.commands, ignored);
    });
}

CourseRerun::Poses CourseRerun::holding(const Command& command, Nanoseconds from, Nanoseconds to) const {
    return toldAlso([&](Trajectory& told) {
        auto& commands = told.commands;
        const auto first = std::lower_bound(commands.begin(), commands.end(), StampedCommand{from, {}},
                                            earlier<StampedCommand>),
                   last = std::upper_bound(first, commands.end(), StampedCommand{to, {}}, earlier<StampedCommand>);
        if (last == commands.begin()) return;
        const StampedCommand after{to, std::prev(last)->command};
        const auto here = commands.erase(first, last);
        commands.insert(here, {{from, command}, after});
    });
}

CourseRerun::Poses CourseRerun::startingAt(const Velocity& velocity) const {
    return run(0, seed_, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        opened.parts.scene.robots[body].velocity = velocity;
    });
}

CourseRerun::Poses CourseRerun::untouched() const {
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

CourseRerun::Poses CourseRerun::movedBy(const std::shared_ptr<const MotionModel>& model) const {
    return run(0, seed_, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        Scene& scene = opened.parts.scene;
        RolloutStart start = *opened.starts[course_.robot];
        fillVelocities(*model, {&start, 1});
        scene.robots[body].velocity = *start.velocity;
        const MotionNoise noise = noiseOf(scene.modelOf(body));
        scene.robots[body].model = static_cast<std::uint32_t>(scene.models.size());
        scene.models.push_back(withNoise(model, noise));
    });
}

CourseRerun::Poses CourseRerun::noisy(const MotionNoise& noise, std::uint64_t seed) const {
    return run(0, seed, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        Scene& scene = opened.parts.scene;
        addMeasuredNoise(noise, {seed, -1, static_cast<std::uint32_t>(body), channelOf(NoiseChannel::motion)},
                         scene.modelOf(body).period(), scene.robots[body].velocity);
        auto model = withNoise(scene.models[scene.robots[body].model], noise);
        scene.robots[body].model = static_cast<std::uint32_t>(scene.models.size());
        scene.models.push_back(std::move(model));
    });
}

CourseRerun::Poses CourseRerun::carried(int from, int to) const {
    const auto index = [](int k) { return static_cast<std::size_t>(k); };
    const std::vector<Pose>& truth = course_.real.truth;
    const Pose before = from == 0 ? course_.real.measuredPose : course_.simulated[index(from) - 1];
    const Pose real = std::isfinite(truth[index(from)].x) ? truth[index(from)] : before;
    const auto carriedTo = [&](int k) { return before * relative(real, truth[index(k)]); };
    Poses poses(course_.simulated.begin(), course_.simulated.begin() + from);
    for (int k = from + 1; k <= to; ++k) poses.push_back(carriedTo(k));
    const Poses after = run(to, seed_, [&](LogWorld::OpenedParts& opened, std::size_t body) {
        SceneRobot& robot = opened.parts.scene.robots[body];
        robot.start = carriedTo(to);
        if (const auto velocity = velocityAt(trajectory().poses, course_.real.start + to * step_))
            robot.velocity = *velocity;
    });
    poses.insert(poses.end(), after.begin(), after.end());
    return poses;
}

}  // namespace mrose
