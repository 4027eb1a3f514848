#include "logs/conditioning.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/point.h"

namespace mrose {
namespace {

constexpr Nanoseconds longestBlip = nanosecondsPerSecond / 25;
constexpr double outlierDistance = 0.1, outlierAngle = 0.5;  // m, rad: beyond what neighbours of a true pose differ by
constexpr double outlierFactor = 3;                          // times the distance of the neighbours

template <class Sample>
void countGaps(const std::vector<Sample>& samples, double limit, std::int64_t& count, double& longest) {
    const Nanoseconds limitTime = fromSeconds(limit);
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const Nanoseconds pause = samples[i].time - samples[i - 1].time;
        if (pause <= limitTime) continue;
        ++count;
        longest = std::max(longest, toSeconds(pause));
    }
}

/// Drops the samples for which isBad(previous kept, sample, next) holds, into `into` if it is given; the first and
/// the last always stay.
template <class Sample, class Predicate>
std::int64_t dropBetween(std::vector<Sample>& samples, Predicate isBad, std::vector<Sample>* into = nullptr) {
    if (samples.size() < 3) return 0;
    std::size_t kept = 1;
    for (std::size_t i = 1; i < samples.size(); ++i)
        if (i + 1 == samples.size() || !isBad(samples[kept - 1], samples[i], samples[i + 1]))
            samples[kept++] = samples[i];
        else if (into != nullptr)
            into->push_back(samples[i]);
    const std::size_t dropped = samples.size() - kept;
    samples.resize(kept);
    return static_cast<std::int64_t>(dropped);
}

bool isBlip(const StampedCommand& before, const StampedCommand& sample, const StampedCommand& after) {
    return sample.command == Command{} && before.command == after.command && before.command != Command{} &&
           after.time - sample.time <= longestBlip;
}

double distance(const Pose& a, const Pose& b) { return length(position(a) - position(b)); }
double turn(const Pose& a, const Pose& b) { return std::abs(wrapAngle(a.heading - b.heading)); }

bool isFarOff(double toBefore, double toAfter, double between, double limit) {
    return std::min(toBefore, toAfter) > limit + outlierFactor * between;
}

/// Cheap, and true of nearly all: too near to the pose before to be far off.
bool isNear(const Pose& a, const Pose& b) {
    const double dx = b.x - a.x, dy = b.y - a.y;
    return dx * dx + dy * dy < outlierDistance * outlierDistance && std::abs(b.heading - a.heading) < outlierAngle;
}

bool isOutlier(const Pose& before, const Pose& pose, const Pose& after) {
    if (isNear(before, pose)) return false;
    return isFarOff(distance(before, pose), distance(pose, after), distance(before, after), outlierDistance) ||
           isFarOff(turn(before, pose), turn(pose, after), turn(before, after), outlierAngle);
}

/// A run of rows behind an earlier one.
struct BackwardRun {
    std::size_t rows = 0, farBehind = 0;  // farBehind: by more than 2 s
    bool toTheEnd = false;
};

bool isForGood(const BackwardRun& run, std::size_t total) {
    if (run.toTheEnd && (run.rows >= 10 || 2 * run.rows >= total)) return true;
    return run.farBehind > 10 && 20 * run.farBehind > total;
}

}  // namespace

void unwrapHeadings(std::vector<StampedPose>& poses, LogDefects& defects) {
    constexpr double wholeTurn = 2 * std::numbers::pi;
    double offset = 0;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        double& heading = poses[i].pose.heading;
        const double jump = heading + offset - poses[i - 1].pose.heading;
        if (std::abs(jump) > std::numbers::pi) {
            offset -= wholeTurn * std::round(jump / wholeTurn);
            ++defects.headingWraps;
        }
        heading += offset;
    }
}

std::optional<ClockReset> findClockReset(std::span<const Nanoseconds> times) {
    std::size_t latest = 0;
    for (std::size_t i = 1; i < times.size();) {
        if (times[i] >= times[latest]) {
            latest = i++;
            continue;
        }
        const std::size_t first = i;
        BackwardRun run;
        for (; i < times.size() && times[i] < times[latest]; ++i, ++run.rows)
            run.farBehind += times[latest] - times[i] > 2 * nanosecondsPerSecond;
        run.toTheEnd = i == times.size();
        if (isForGood(run, times.size())) return ClockReset{first, latest, times[latest] - times[first]};
    }
    return std::nullopt;
}

void conditionCommands(std::vector<StampedCommand>& commands, const LogOptions& options, LogDefects& defects,
                       std::vector<StampedCommand>* blips) {
    sortByTime(commands, defects);
    keepLastOfEqualStamps(commands, defects);
    if (options.dropBlips) defects.blips += dropBetween(commands, isBlip, blips);
    countGaps(commands, options.commandGap, defects.commandGaps, defects.longestCommandGap);
}

void conditionKicks(std::vector<StampedKick>& kicks, LogDefects& defects) {
    sortByTime(kicks, defects);
    keepLastOfEqualStamps(kicks, defects);
}

void conditionBall(std::vector<StampedBall>& ball, const LogOptions& options, LogDefects& defects) {
    sortByTime(ball, defects);
    keepLastOfEqualStamps(ball, defects);
    const Nanoseconds longest = fromSeconds(options.ballGap);
    defects.ballOutliers += dropBetween(ball, [&](const auto& before, const auto& sample, const auto& after) {
        const auto between = [](const StampedBall& a, const StampedBall& b) { return length(b.place - a.place); };
        return after.time - before.time <= longest &&
               isFarOff(between(before, sample), between(sample, after), between(before, after), outlierDistance);
    });
    countGaps(ball, options.ballGap, defects.ballGaps, defects.longestBallGap);
}

void conditionPoses(std::vector<StampedPose>& poses, const LogOptions& options, LogDefects& defects) {
    sortByTime(poses, defects);
    keepLastOfEqualStamps(poses, defects);
    const Nanoseconds longest = fromSeconds(options.poseGap);
    defects.poseOutliers += dropBetween(poses, [&](const auto& before, const auto& sample, const auto& after) {
        return after.time - before.time <= longest && isOutlier(before.pose, sample.pose, after.pose);
    });
    unwrapHeadings(poses, defects);
    countGaps(poses, options.poseGap, defects.poseGaps, defects.longestPoseGap);
}

}  // namespace mrose
