#include "debug/pose_track.h"

#include <algorithm>

namespace mrose {

void PoseTrack::add(const WorldState& state) {
    const auto in = static_cast<std::uint32_t>(ticks_ % TrailBlock::capacity);
    if (in == 0) blocks_.push_back(std::make_shared<TrailBlock>(state.robots.size() + state.objects.size()));
    std::size_t body = 0;
    const auto put = [&](const Pose& pose) {
        blocks_.back()->at(body++, in) = {static_cast<float>(pose.x), static_cast<float>(pose.y),
                                          static_cast<float>(wrapAngle(pose.heading))};
    };
    for (const RobotState& robot : state.robots) put(robot.pose);
    for (const ObjectState& object : state.objects) put(object.pose);
    ++ticks_;
}

bool PoseTrack::forgetEarliest() {
    if (blocks_.size() < 2) return false;
    blocks_.pop_front();
    first_ += TrailBlock::capacity;
    ticks_ -= TrailBlock::capacity;
    return true;
}

void PoseTrack::addTrails(std::int64_t tick, std::size_t ticks, Trails& trails) const {
    constexpr std::int64_t capacity = TrailBlock::capacity;
    const std::int64_t end = std::min(tick, last()) + 1 - first_;
    const std::int64_t begin = std::max<std::int64_t>(0, tick - static_cast<std::int64_t>(ticks) - first_);
    for (std::int64_t from = begin; from < end;) {
        const std::int64_t block = from / capacity, to = std::min(end, (block + 1) * capacity);
        trails.pieces.push_back({blocks_[static_cast<std::size_t>(block)],
                                 static_cast<std::uint32_t>(from - block * capacity),
                                 static_cast<std::uint32_t>(to - block * capacity), from == begin});
        from = to;
    }
}

std::vector<Pose> PoseTrack::posesAt(std::int64_t tick) const {
    const auto at = static_cast<std::size_t>(tick - first_);
    const TrailBlock& block = *blocks_[at / TrailBlock::capacity];
    std::vector<Pose> poses;
    poses.reserve(block.bodies());
    for (std::size_t body = 0; body < block.bodies(); ++body) {
        const TrailBlock::Place& place = block.at(body, static_cast<std::uint32_t>(at % TrailBlock::capacity));
        poses.push_back({place.x, place.y, place.heading});
    }
    return poses;
}

}  // namespace mrose
