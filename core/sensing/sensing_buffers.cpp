#include "sensing/sensing_buffers.h"

#include <algorithm>
#include <limits>

namespace mrose {
namespace {

// Up to here a single cell is quicker than a grid.
constexpr std::size_t bodiesOfOneCell = 24;

void fill(BodyMap& map, const PastPoses& past, const WorldState& state, std::int64_t lag, double earlier) {
    map.lag = lag;
    map.earlier = earlier;
    map.positions.clear();
    if (earlier > 0) {
        for (std::size_t body = 0; body < state.robots.size() + state.objects.size(); ++body)
            map.positions.push_back(position(past.poseBetween(state, body, lag, earlier)));
    } else if (lag == 0) {
        for (const RobotState& robot : state.robots) map.positions.push_back(position(robot.pose));
        for (const ObjectState& object : state.objects) map.positions.push_back(position(object.pose));
    } else {
        for (const Pose& pose : past.posesBefore(state, lag)) map.positions.push_back(position(pose));
    }
    const bool few = map.positions.size() <= bodiesOfOneCell;
    map.grid.fill(map.positions, few ? std::numeric_limits<double>::infinity() : 0, 1);
}

}  // namespace

const BodyMap& SensingBuffers::bodiesBefore(const PastPoses& past, const WorldState& state, std::int64_t lag,
                                            double earlier) {
    const auto end = maps_.begin() + static_cast<std::ptrdiff_t>(used_);
    const auto found =
        std::find_if(maps_.begin(), end, [&](const auto& map) { return map->lag == lag && map->earlier == earlier; });
    if (found != end) return **found;
    if (used_ == maps_.size()) maps_.push_back(std::make_unique<BodyMap>());
    fill(*maps_[used_], past, state, lag, earlier);
    return *maps_[used_++];
}

std::span<const double> SensingBuffers::coresOf(const Scene& scene) {
    if (cores_.empty())
        for (std::size_t body = 0; body < scene.bodyCount(); ++body) cores_.push_back(scene.shapeOf(body).core);
    return cores_;
}

}  // namespace mrose
