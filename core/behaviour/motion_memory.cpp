#include "behaviour/motion_memory.h"

#include <algorithm>

#include "geometry/pose.h"

namespace mrose {

void MotionMemory::observe(const Observation& observation) {
    count = std::min(count + 1, capacity);
    std::move_backward(instants.begin(), instants.end() - 1, instants.end());
    instants[0] = {observation.time, observation.velocity(), count > 1 ? instants[1].command : Command{}};
}

Command MotionMemory::commandAt(Nanoseconds time) const {
    for (std::int64_t i = 0; i < count; ++i)
        if (instants[i].time <= time) return instants[i].command;
    return count > 0 ? instants[count - 1].command : Command{};
}

Pose MotionMemory::motionSince(Nanoseconds time) const {
    Pose motion;
    for (std::int64_t i = 0; i + 1 < count && instants[i].time > time; ++i) {
        const Instant &newer = instants[i], &older = instants[i + 1];
        const double duration = toSeconds(newer.time - std::max(older.time, time));
        motion = exp({duration * (newer.velocity.v + older.velocity.v) / 2, 0,
                      duration * (newer.velocity.w + older.velocity.w) / 2}) *
                 motion;
    }
    return motion;
}

Pose MotionMemory::motionDuring(double deadTime) const {
    Pose motion;
    const Nanoseconds begin = now() - fromSeconds(deadTime);
    Nanoseconds end = now();
    for (std::int64_t i = 0; i < count && end > begin; ++i) {
        const double duration = toSeconds(end - std::max(instants[i].time, begin));
        motion = exp({duration * instants[i].command.v, 0, duration * instants[i].command.w}) * motion;
        end = instants[i].time;
    }
    return motion;
}

}  // namespace mrose
