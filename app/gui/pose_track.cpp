#include "pose_track.h"

#include <algorithm>

namespace mrose::gui {

void PoseTrack::add(const WorldState& state) {
    if (rows_.empty()) first_ = state.tick;
    Row row;
    row.reserve(state.robots.size() + state.objects.size());
    const auto place = [](const Pose& pose) {
        return Place{static_cast<float>(pose.x), static_cast<float>(pose.y),
                     static_cast<float>(wrapAngle(pose.heading))};
    };
    for (const RobotState& robot : state.robots) row.push_back(place(robot.pose));
    for (const ObjectState& object : state.objects) row.push_back(place(object.pose));
    rows_.push_back(std::move(row));
    if (rows_.size() * (rows_.back().size() * sizeof(Place) + sizeof(Row)) <= mostBytes) return;
    rows_.pop_front();
    ++first_;
}

std::vector<std::vector<Point>> PoseTrack::trails(std::int64_t tick, std::size_t ticks) const {
    const std::int64_t end = std::min(tick, last());
    const std::int64_t begin = std::max(first_, end - static_cast<std::int64_t>(ticks));
    std::vector<std::vector<Point>> trails(rows_.front().size());
    if (end < begin) return trails;
    for (std::size_t body = 0; body < trails.size(); ++body) {
        trails[body].reserve(static_cast<std::size_t>(end - begin + 1));
        for (std::int64_t t = begin; t <= end; ++t) {
            const Place& place = rows_[static_cast<std::size_t>(t - first_)][body];
            trails[body].push_back({place.x, place.y});
        }
    }
    return trails;
}

std::vector<Pose> PoseTrack::posesAt(std::int64_t tick) const {
    const Row& row = rows_[static_cast<std::size_t>(tick - first_)];
    std::vector<Pose> poses;
    poses.reserve(row.size());
    for (const Place& place : row) poses.push_back({place.x, place.y, place.heading});
    return poses;
}

}  // namespace mrose::gui
