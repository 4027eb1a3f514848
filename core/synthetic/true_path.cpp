#include "synthetic/true_path.h"

#include <algorithm>

#include "geometry/point.h"

namespace mrose {

Pose TruePath::at(Nanoseconds time) const {
    const auto after = std::ranges::lower_bound(samples_, time, {}, &StampedPose::time);
    if (after == samples_.begin()) return samples_.front().pose;
    if (after == samples_.end()) return samples_.back().pose;
    const StampedPose &a = *(after - 1), &b = *after;
    const double share = static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time);
    const auto between = [&](double from, double to) { return from + share * (to - from); };
    return {between(a.pose.x, b.pose.x), between(a.pose.y, b.pose.y), between(a.pose.heading, b.pose.heading)};
}

Velocity TruePath::velocityAt(Nanoseconds time) const {
    constexpr Nanoseconds half = 50'000'000;
    const Pose from = at(time - half), to = at(time + half);
    const double seconds = toSeconds(2 * half);
    return {dot(position(to) - position(from), towards(at(time).heading)) / seconds,
            (to.heading - from.heading) / seconds};
}

}  // namespace mrose
