#include "logs/pose_grid.h"

#include <algorithm>
#include <span>

namespace mrose {
namespace {

constexpr Nanoseconds millisecond = 1'000'000;
constexpr Nanoseconds halfWidth = 60 * millisecond, gapLimit = 200 * millisecond;
constexpr Nanoseconds startWidth = 200 * millisecond;
constexpr Nanoseconds settling = 1500 * millisecond, ending = 1000 * millisecond;
constexpr std::size_t fewest = 4;  // samples of a fit

using Poses = std::span<const StampedPose>;

/// Index of the first pose at or after `time`, not before `from`.
std::size_t firstNotBefore(Poses poses, Nanoseconds time, std::size_t from) {
    while (from < poses.size() && poses[from].time < time) ++from;
    return from;
}

/// The least-squares straight line through the poses, at `time`.
Pose fitLine(Poses poses, Nanoseconds time) {
    const double count = static_cast<double>(poses.size());
    double meanTime = 0;
    Pose mean;
    for (const auto& [stamp, pose] : poses) {
        meanTime += toSeconds(stamp - time) / count;
        mean = {mean.x + pose.x / count, mean.y + pose.y / count, mean.heading + pose.heading / count};
    }
    double squares = 0;
    Pose moments;
    for (const auto& [stamp, pose] : poses) {
        const double lever = toSeconds(stamp - time) - meanTime;
        squares += lever * lever;
        moments = {moments.x + lever * (pose.x - mean.x), moments.y + lever * (pose.y - mean.y),
                   moments.heading + lever * (pose.heading - mean.heading)};
    }
    const double back = -meanTime / squares;
    return {mean.x + back * moments.x, mean.y + back * moments.y, mean.heading + back * moments.heading};
}

Pose interpolate(const StampedPose& a, const StampedPose& b, Nanoseconds time) {
    const double share =
        std::clamp(static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time), 0.0, 1.0);
    const auto between = [&](double from, double to) { return from + share * (to - from); };
    return {between(a.pose.x, b.pose.x), between(a.pose.y, b.pose.y), between(a.pose.heading, b.pose.heading)};
}

Nanoseconds ceilToMultiple(Nanoseconds time, Nanoseconds step) {
    const Nanoseconds rest = ((time % step) + step) % step;
    return rest == 0 ? time : time + step - rest;
}

}  // namespace

PoseGrid poseGrid(const Trajectory& trajectory, Nanoseconds step, Nanoseconds offset) {
    PoseGrid grid;
    grid.step = step;
    const Poses poses = trajectory.poses;
    if (poses.size() < 2 || trajectory.commands.empty()) return grid;
    const Nanoseconds begin = std::max(trajectory.commands.front().time, poses.front().time) + settling;
    const Nanoseconds end = std::min(trajectory.commands.back().time, poses.back().time) - ending;
    grid.start = ceilToMultiple(begin - offset, step) + offset;
    std::size_t low = 0, high = 0, next = 0;
    for (Nanoseconds time = grid.start; time < end; time += step) {
        low = firstNotBefore(poses, time - halfWidth, low);
        high = firstNotBefore(poses, time + halfWidth, high);
        next = firstNotBefore(poses, time, next);
        const std::size_t after = std::clamp<std::size_t>(next, 1, poses.size() - 1);
        grid.poses.push_back(high - low >= fewest ? fitLine(poses.subspan(low, high - low), time)
                                                  : interpolate(poses[after - 1], poses[after], time));
        grid.ok.push_back(poses[after].time - poses[after - 1].time < gapLimit);
    }
    return grid;
}

MeasuredStart measuredStart(const Trajectory& trajectory, Nanoseconds time) {
    const Poses poses = trajectory.poses;
    const auto later = [](Nanoseconds t, const StampedPose& pose) { return t < pose.time; };
    const auto behind = std::upper_bound(poses.begin(), poses.end(), time, later);
    const auto first = std::upper_bound(poses.begin(), behind, time - startWidth, later);
    const Poses recent(first, behind);
    if (recent.size() < fewest) return {};
    const Pose pose = fitLine(recent, time), before = fitLine(recent, time - 100 * millisecond);
    const Pose step = relative(before, pose);
    return {true, pose, {10 * step.x, 10 * step.heading}};
}

}  // namespace mrose
