#include "assessment/reality.h"

#include <algorithm>
#include <limits>

#include "logs/pose_grid.h"

namespace mrose {
namespace {

using Stretches = std::vector<Reality::Robot::Stretch>;
constexpr Nanoseconds forGood = std::numeric_limits<Nanoseconds>::max();

/// What lies in stretches of both.
Stretches common(const Stretches& a, const Stretches& b) {
    Stretches both;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size(); a[i].to < b[j].to ? ++i : ++j) {
        const Nanoseconds from = std::max(a[i].from, b[j].from), to = std::min(a[i].to, b[j].to);
        if (from < to) both.push_back({from, to});
    }
    return both;
}

}  // namespace

std::optional<Pose> Reality::Robot::poseAt(Nanoseconds now) const {
    const Nanoseconds time = origin + now;
    if (!truthIsKnown(trajectory->poses, time)) return {};
    return truthAt(trajectory->poses, time);
}

std::optional<Velocity> Reality::Robot::velocityAt(Nanoseconds now) const {
    return mrose::velocityAt(trajectory->poses, origin + now);
}

std::span<const StampedPose> Reality::Robot::posesBetween(Nanoseconds from, Nanoseconds to) const {
    const std::vector<StampedPose>& poses = trajectory->poses;
    const auto first = std::lower_bound(poses.begin(), poses.end(), origin + from,
                                        [](const StampedPose& p, Nanoseconds t) { return p.time < t; });
    const auto last = std::upper_bound(first, poses.end(), origin + to,
                                       [](Nanoseconds t, const StampedPose& p) { return t < p.time; });
    return {first, last};
}

std::vector<Reality::Robot::Stretch> Reality::Robot::unknownBetween(Nanoseconds from, Nanoseconds to) const {
    std::vector<Stretch> stretches;
    Nanoseconds known = from;
    const auto end = [&](Nanoseconds time, bool gap) {
        if (gap && time > known) stretches.push_back({known, time});
        known = std::max(known, time);
    };
    const std::vector<StampedPose>& poses = trajectory->poses;
    for (std::size_t i = 0; i < poses.size() && known < to; ++i)
        end(std::min(poses[i].time - origin, to), i == 0 || poses[i].time - poses[i - 1].time >= truthGap);
    end(to, true);
    return stretches;
}

std::vector<Reality::Robot::Stretch> Reality::unknownOf(const Robot* robot) const {
    if (robot != nullptr) {
        const std::vector<StampedPose>& poses = robot->trajectory->poses;
        const Nanoseconds end = poses.empty() ? 0 : std::max<Nanoseconds>(0, poses.back().time - robot->origin);
        Stretches unknown = robot->unknownBetween(0, end);
        unknown.push_back({end, forGood});
        return unknown;
    }
    Stretches unknown{{0, forGood}};
    for (const Robot& one : robots) unknown = common(unknown, unknownOf(&one));
    return unknown;
}

std::optional<Pose> Reality::ModelRollout::poseAt(std::size_t robot, Nanoseconds now) const {
    if (robot >= poses.size()) return {};
    const std::vector<Pose>& rollout = poses[robot];
    if (now < 0 || now / step >= static_cast<Nanoseconds>(rollout.size())) return {};
    return rollout[static_cast<std::size_t>(now / step)];
}

const Reality::Robot* Reality::robotNamed(const std::string& simulated) const {
    const auto found =
        std::find_if(robots.begin(), robots.end(), [&](const Robot& robot) { return robot.name == simulated; });
    return found == robots.end() ? nullptr : &*found;
}

std::optional<PoseError> Reality::modelError(const ModelRollout& model, std::size_t robot, Nanoseconds now) const {
    const auto predicted = model.poseAt(robot, now);
    if (!predicted) return {};
    const auto real = robots[robot].poseAt(now - now % model.step);
    return real ? std::optional(poseError(*real, *predicted)) : std::nullopt;
}

std::optional<Pose> Reality::poseOf(const std::string& simulated, Nanoseconds now) const {
    const Robot* const robot = robotNamed(simulated);
    return robot == nullptr ? std::nullopt : robot->poseAt(now);
}

std::optional<Velocity> Reality::velocityOf(const std::string& simulated, Nanoseconds now) const {
    const Robot* const robot = robotNamed(simulated);
    return robot == nullptr ? std::nullopt : robot->velocityAt(now);
}

std::vector<std::string> Reality::modelNames() const {
    std::vector<std::string> names;
    for (const ModelRollout& model : models) names.push_back(model.name);
    return names;
}

std::optional<PoseError> Reality::errorOf(const std::string& model, const std::string& simulated,
                                          Nanoseconds now) const {
    const Robot* const robot = robotNamed(simulated);
    const auto found =
        std::find_if(models.begin(), models.end(), [&](const ModelRollout& one) { return one.name == model; });
    if (robot == nullptr || found == models.end()) return {};
    return modelError(*found, static_cast<std::size_t>(robot - robots.data()), now);
}

Reality realityOf(const LogWorld& world, std::size_t session, Nanoseconds start) {
    Reality reality;
    reality.log = world.sharedLog();
    reality.start = start;
    reality.allRobots = world.allRobots();
    for (std::size_t i = 0; i < world.robots().size(); ++i)
        reality.robots.push_back({world.robots()[i].name, world.robots()[i].realName, &world.trajectory(session, i),
                                  world.sessions()[session].parts[i].origin + start});
    return reality;
}

}  // namespace mrose
