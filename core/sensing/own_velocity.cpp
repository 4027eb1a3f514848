#include "sensing/own_velocity.h"

#include <algorithm>

#include "sensing/sensor_view.h"

namespace mrose {

Nanoseconds velocityReach(Nanoseconds latency) {
    constexpr Nanoseconds least = 40'000'000;
    return std::max(latency, least);
}

Velocity ownVelocity(const SensorView& view, const Placement& own, Nanoseconds reach) {
    const Nanoseconds before = view.measured - reach;
    const Nanoseconds after = std::min(view.measured + reach, view.timeBefore(0));
    const Pose from = view.poseAt(view.robot, before), to = view.poseAt(view.robot, after);
    const double duration = toSeconds(after - before);
    return {own.rotateBack(position(to) - position(from)).x / duration, (to.heading - from.heading) / duration};
}

}  // namespace mrose
