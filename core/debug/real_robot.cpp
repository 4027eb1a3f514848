#include "debug/real_robot.h"

#include <algorithm>

namespace mrose {
namespace {

std::optional<RealRobot> realRobot(const FieldFrame& frame, std::size_t index, std::optional<std::size_t> body) {
    const Reality::Robot& of = frame.reality->robots[index];
    const Nanoseconds now = frame.now();
    const Scene& scene = frame.scene();
    const auto place = body ? std::optional(scene.placeOf(*body)) : std::nullopt;
    RealRobot robot{index, body, place, &scene.shapeOf(body.value_or(0)), {}, {}, {}};
    if (const auto pose = of.poseAt(now)) {
        robot.pose = *pose;
        if (body) robot.apart = poseError(*pose, frame.poseOf(*body));
        return robot;
    }
    const std::vector<StampedPose>& poses = of.trajectory->poses;
    const auto next = std::upper_bound(poses.begin(), poses.end(), of.origin + now,
                                       [](Nanoseconds t, const StampedPose& pose) { return t < pose.time; });
    if (next == poses.begin()) return std::nullopt;
    robot.pose = std::prev(next)->pose;
    robot.lostFor = of.origin + now - std::prev(next)->time;
    return robot;
}

}  // namespace

const char* realWord(const FieldFrame& frame) { return frame.reality ? frame.reality->real() : "real"; }

std::optional<std::size_t> bodyOf(const FieldFrame& frame, const Reality::Robot& robot) {
    const std::vector<SceneRobot>& robots = frame.scene().robots;
    const auto found =
        std::find_if(robots.begin(), robots.end(), [&](const SceneRobot& one) { return one.name == robot.name; });
    if (found == robots.end()) return std::nullopt;
    return static_cast<std::size_t>(found - robots.begin());
}

std::vector<RealRobot> realRobots(const FieldFrame& frame) {
    std::vector<RealRobot> robots;
    if (!frame.reality || frame.scene().robots.empty()) return robots;
    for (std::size_t i = 0; i < frame.reality->robots.size(); ++i)
        if (auto robot = realRobot(frame, i, bodyOf(frame, frame.reality->robots[i]))) robots.push_back(*robot);
    return robots;
}

std::optional<RealRobot> realRobotOf(const FieldFrame& frame, std::size_t body) {
    if (!frame.reality || body >= frame.scene().robots.size()) return std::nullopt;
    const Reality::Robot* const robot = frame.reality->robotNamed(frame.scene().robots[body].name);
    if (robot == nullptr) return std::nullopt;
    return realRobot(frame, static_cast<std::size_t>(robot - frame.reality->robots.data()), body);
}

Area areaOf(const Reality& reality) {
    constexpr Nanoseconds span = 60 * nanosecondsPerSecond;
    Area area{{1, 1}, {-1, -1}};
    for (const Reality::Robot& robot : reality.robots)
        for (const StampedPose& stamped : robot.posesBetween(0, span)) area.include(position(stamped.pose));
    for (const Reality::ModelRollout& model : reality.models)
        for (const std::vector<Pose>& poses : model.poses)
            for (std::size_t i = 0; i < poses.size() && static_cast<Nanoseconds>(i) * model.step <= span; ++i)
                area.include(position(poses[i]));
    return area;
}

}  // namespace mrose
