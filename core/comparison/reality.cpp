#include "comparison/reality.h"

#include <algorithm>
#include <cmath>

#include "logs/pose_grid.h"

namespace mrose {

std::optional<Pose> Reality::Robot::poseAt(Nanoseconds now) const {
    const Nanoseconds time = origin + now;
    if (!truthIsKnown(trajectory->poses, time)) return {};
    return truthAt(trajectory->poses, time);
}

std::span<const StampedPose> Reality::Robot::posesBetween(Nanoseconds from, Nanoseconds to) const {
    const std::vector<StampedPose>& poses = trajectory->poses;
    const auto first = std::lower_bound(poses.begin(), poses.end(), origin + from,
                                        [](const StampedPose& p, Nanoseconds t) { return p.time < t; });
    const auto last = std::upper_bound(first, poses.end(), origin + to,
                                       [](Nanoseconds t, const StampedPose& p) { return t < p.time; });
    return {first, last};
}

std::optional<Pose> Reality::ModelCourse::poseAt(std::size_t robot, Nanoseconds now) const {
    if (robot >= poses.size()) return {};
    const std::vector<Pose>& course = poses[robot];
    if (now < 0 || now / step >= static_cast<Nanoseconds>(course.size())) return {};
    return course[static_cast<std::size_t>(now / step)];
}

const Reality::Robot* Reality::robotNamed(const std::string& simulated) const {
    const auto found =
        std::find_if(robots.begin(), robots.end(), [&](const Robot& robot) { return robot.name == simulated; });
    return found == robots.end() ? nullptr : &*found;
}

std::optional<PoseError> Reality::modelError(const ModelCourse& model, std::size_t robot, Nanoseconds now) const {
    const auto predicted = model.poseAt(robot, now);
    if (!predicted) return {};
    const auto real = robots[robot].poseAt(now - now % model.step);
    return real ? std::optional(poseError(*real, *predicted)) : std::nullopt;
}

PoseError poseError(const Pose& real, const Pose& simulated) {
    return {std::hypot(simulated.x - real.x, simulated.y - real.y),
            std::abs(wrapAngle(simulated.heading - real.heading))};
}

Reality realityOf(const LogWorld& world, std::shared_ptr<const Log> log, std::size_t take, Nanoseconds start) {
    Reality reality{std::move(log), start, {}, {}};
    for (std::size_t i = 0; i < world.robots().size(); ++i)
        reality.robots.push_back({world.robots()[i].name, world.robots()[i].realName, &world.trajectory(take, i),
                                  world.takes()[take].parts[i].origin + start});
    return reality;
}

}  // namespace mrose
