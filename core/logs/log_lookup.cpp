#include "logs/log_lookup.h"

#include <algorithm>

namespace mrose {

const Trajectory* trajectoryBeside(const Trajectory& own, const RobotLog& other) {
    const auto found = std::ranges::find(other.trajectories, own.name, &Trajectory::name);
    if (found != other.trajectories.end()) return &*found;
    return other.trajectories.size() == 1 ? &other.trajectories.front() : nullptr;
}

}  // namespace mrose
