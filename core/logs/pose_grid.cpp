#include "logs/pose_grid.h"

#include <algorithm>
#include <span>

#include "geometry/point.h"

namespace mrose {
namespace {

constexpr Nanoseconds millisecond = 1'000'000;
constexpr Nanoseconds halfWidth = 60 * millisecond;
constexpr Nanoseconds startWidth = 200 * millisecond, oldest = 600 * millisecond;
constexpr std::size_t fewest = 4;  // samples of a fit
/// Of a grid: where poses lie farther apart on average, nothing is known between nearly all of them.
constexpr std::int64_t mostSteps = 10'000'000, mostStepsPerPose = 1000;

using Poses = std::span<const StampedPose>;

/// Index of the first pose at or after `time`.
std::size_t firstNotBefore(Poses poses, Nanoseconds time) {
    const auto earlier = [](const StampedPose& pose, Nanoseconds t) { return pose.time < t; };
    return static_cast<std::size_t>(std::lower_bound(poses.begin(), poses.end(), time, earlier) - poses.begin());
}

/// The same for instants that ascend: searched from `from` on.
std::size_t firstNotBefore(Poses poses, Nanoseconds time, std::size_t from) {
    while (from < poses.size() && poses[from].time < time) ++from;
    return from;
}

struct Line {
    Pose value;
    Pose slope;  // per second
};

/// The least-squares straight line through the poses, at `time`.
Line fitLine(Poses poses, Nanoseconds time) {
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
    const Pose slope{moments.x / squares, moments.y / squares, moments.heading / squares};
    return {{mean.x - meanTime * slope.x, mean.y - meanTime * slope.y, mean.heading - meanTime * slope.heading}, slope};
}

/// The straight line from one pose to the next, at `time`; level outside them.
Line chord(const StampedPose& a, const StampedPose& b, Nanoseconds time) {
    const double duration = toSeconds(b.time - a.time);
    const Pose slope{(b.pose.x - a.pose.x) / duration, (b.pose.y - a.pose.y) / duration,
                     (b.pose.heading - a.pose.heading) / duration};
    const double since = toSeconds(std::clamp(time, a.time, b.time) - a.time);
    return {{a.pose.x + since * slope.x, a.pose.y + since * slope.y, a.pose.heading + since * slope.heading}, slope};
}

Velocity velocityOf(const Line& line) {
    return {dot(towards(line.value.heading), position(line.slope)), line.slope.heading};
}

/// The end of the samples at or before `time`.
template <class Sample>
auto behind(const std::vector<Sample>& samples, Nanoseconds time) {
    return std::upper_bound(samples.begin(), samples.end(), time,
                            [](Nanoseconds instant, const Sample& sample) { return instant < sample.time; });
}

/// Those of the last 0.2 s, or the last four if a gap left fewer and they are no older than 0.6 s.
Poses recentPoses(Poses known, Nanoseconds time) {
    std::size_t count = 0;
    while (count < known.size()) {
        const Nanoseconds age = time - known[known.size() - 1 - count].time;
        if (age >= (count < fewest ? oldest : startWidth)) break;
        ++count;
    }
    return known.last(count);
}

Nanoseconds middleOf(Poses poses) {
    Nanoseconds sum = 0;
    for (const StampedPose& pose : poses) sum += pose.time - poses.front().time;
    return poses.front().time + sum / static_cast<Nanoseconds>(poses.size());
}

std::optional<Velocity> meanOfLast(const std::vector<StampedVelocity>& samples, Nanoseconds time) {
    Velocity sum;
    int count = 0;
    for (auto at = behind(samples, time); at != samples.begin() && time - std::prev(at)->time < startWidth; --at) {
        sum.v += std::prev(at)->velocity.v;
        sum.w += std::prev(at)->velocity.w;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return Velocity{sum.v / count, sum.w / count};
}

Nanoseconds ceilToMultiple(Nanoseconds time, Nanoseconds step) {
    const Nanoseconds rest = ((time % step) + step) % step;
    return rest == 0 ? time : time + step - rest;
}

}  // namespace

PoseGrid poseGrid(const Trajectory& trajectory, Nanoseconds step, const GridMargins& margins) {
    PoseGrid grid;
    grid.step = step;
    const Poses poses = trajectory.poses;
    if (poses.size() < 2 || trajectory.commands.empty()) return grid;
    const Nanoseconds begin = std::max(trajectory.commands.front().time, poses.front().time) + margins.begin;
    const Nanoseconds end = std::min(trajectory.commands.back().time, poses.back().time) - margins.end;
    if ((end - begin) / step > mostSteps + mostStepsPerPose * static_cast<std::int64_t>(poses.size())) return grid;
    grid.start = ceilToMultiple(begin, step);
    std::size_t low = 0, high = 0, next = 0;
    for (Nanoseconds time = grid.start; time < end; time += step) {
        low = firstNotBefore(poses, time - halfWidth, low);
        high = firstNotBefore(poses, time + halfWidth, high);
        next = firstNotBefore(poses, time, next);
        const std::size_t after = std::clamp<std::size_t>(next, 1, poses.size() - 1);
        const Line line = high - low >= fewest ? fitLine(poses.subspan(low, high - low), time)
                                               : chord(poses[after - 1], poses[after], time);
        grid.poses.push_back(line.value);
        grid.velocities.push_back(velocityOf(line));
        grid.ok.push_back(poses[after].time - poses[after - 1].time < truthGap);
    }
    return grid;
}

Pose truthAt(std::span<const StampedPose> poses, Nanoseconds time) {
    if (time <= poses.front().time) return poses.front().pose;
    if (time >= poses.back().time) return poses.back().pose;
    const auto firstAt = [&](Nanoseconds instant) { return firstNotBefore(poses, instant); };
    const std::size_t low = firstAt(time - halfWidth), high = firstAt(time + halfWidth), next = firstAt(time);
    const bool bothSides = poses.front().time <= time - halfWidth && poses.back().time >= time + halfWidth;
    return bothSides && high - low >= fewest ? fitLine(poses.subspan(low, high - low), time).value
                                             : chord(poses[next - 1], poses[next], time).value;
}

std::optional<Velocity> velocityAt(Poses poses, Nanoseconds time) {
    if (!truthIsKnown(poses, time) || poses.front().time > time - halfWidth || poses.back().time < time + halfWidth)
        return std::nullopt;
    const std::size_t low = firstNotBefore(poses, time - halfWidth), high = firstNotBefore(poses, time + halfWidth);
    if (high - low < fewest) return std::nullopt;
    return velocityOf(fitLine(poses.subspan(low, high - low), time));
}

bool truthIsKnown(Poses poses, Nanoseconds time) {
    if (poses.size() < 2 || time < poses.front().time || time > poses.back().time) return false;
    const std::size_t after = std::max<std::size_t>(firstNotBefore(poses, time), 1);
    return poses[after].time - poses[after - 1].time < truthGap;
}

MeasuredStart measuredStart(const Trajectory& trajectory, Nanoseconds time) {
    const Poses known(trajectory.poses.begin(), behind(trajectory.poses, time));
    if (known.empty() || time - known.back().time > truthGap) return {};
    const Poses recent = recentPoses(known, time);
    MeasuredStart start{true, known.back().pose, {time, measuredVelocity(trajectory, time).value_or(Velocity{})}};
    if (recent.size() < fewest) return start;
    const Pose slope = fitLine(recent, time).slope;
    const double age = toSeconds(time - known.back().time);
    start.pose = {start.pose.x + age * slope.x, start.pose.y + age * slope.y, start.pose.heading + age * slope.heading};
    start.velocity = {middleOf(recent), velocityOf({start.pose, slope})};
    return start;
}

std::optional<Velocity> measuredVelocity(const Trajectory& trajectory, Nanoseconds time) {
    auto mean = meanOfLast(trajectory.measuredVelocity, time);
    if (const auto rotation = meanOfLast(trajectory.measuredRotation, time)) {
        if (!mean) mean = Velocity{};
        mean->w = rotation->w;
    }
    return mean;
}

}  // namespace mrose
