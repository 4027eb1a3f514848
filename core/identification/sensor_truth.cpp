#include "identification/sensor_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>

#include "geometry/pose.h"
#include "identification/robust_statistics.h"
#include "logs/log_lookup.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

constexpr Nanoseconds misfitBlock = 10 * nanosecondsPerSecond;
constexpr double absent = std::numeric_limits<double>::quiet_NaN();

const Trajectory* trajectoryOf(const LogSubject& subject, const Log& log, const Trajectory& beside) {
    const auto robot = std::ranges::find(log.robots, subject.robot, &RobotLog::robot);
    return robot == log.robots.end() ? nullptr : trajectoryBeside(beside, *robot);
}

std::optional<Pose> poseAt(const Trajectory& trajectory, Nanoseconds time) {
    if (!truthIsKnown(trajectory.poses, time)) return std::nullopt;
    return truthAt(trajectory.poses, time);
}

/// Blocks of 10 s, numbered through all trajectories.
class BlockNumbers {
public:
    std::int32_t of(std::size_t trajectory, Nanoseconds time) {
        if (trajectory != trajectory_) trajectory_ = trajectory, start_ = time, first_ = last_ + 1;
        last_ = first_ + static_cast<std::int32_t>((time - start_) / misfitBlock);
        return last_;
    }

private:
    std::size_t trajectory_ = std::numeric_limits<std::size_t>::max();
    Nanoseconds start_ = 0;
    std::int32_t first_ = 0, last_ = -1;
};

void addKnown(std::vector<KnownReading>& known, const Log& log, const Trajectory& trajectory, std::size_t index,
              const Look& look) {
    for (const LogReading& reading : look.readings) {
        const LogSubject& subject = log.subjects[reading.subject];
        KnownReading found{index, look.time, reading, &trajectory, nullptr, {}};
        if (subject.position)
            found.landmark = *subject.position;
        else if (subject.kind == LogSubject::Kind::robot)
            found.subject = trajectoryOf(subject, log, trajectory);
        if ((subject.position || found.subject != nullptr) && misfitOf(found, 0)) known.push_back(found);
    }
}

/// Two poses of one localisation, about a second apart.
struct ReportedStep {
    const Trajectory* trajectory = nullptr;
    Nanoseconds begin = 0, end = 0;
    Pose moved;
};

void addSteps(std::vector<ReportedStep>& steps, LateMisfits& misfits, BlockNumbers& blocks, std::size_t index,
              const Trajectory& trajectory, const std::vector<StampedPose>& poses) {
    constexpr Nanoseconds shortest = nanosecondsPerSecond, longest = 2 * nanosecondsPerSecond;
    for (std::size_t i = 0, j = 0; i < poses.size(); ++i) {
        while (j < poses.size() && poses[j].time - poses[i].time < shortest) ++j;
        if (j == poses.size()) return;
        if (poses[j].time - poses[i].time > longest) continue;
        steps.push_back({&trajectory, poses[i].time, poses[j].time, relative(poses[i].pose, poses[j].pose)});
        for (const std::int32_t kind : {0, 1}) {
            misfits.kinds.push_back(kind);
            misfits.blocks.push_back(blocks.of(index, poses[i].time));
        }
    }
}

struct ReportedSteps {
    std::vector<ReportedStep> steps;
    LateMisfits misfits;  ///< two of each step
};

ReportedSteps reportedSteps(const RobotLog& robot, const std::string& sensor) {
    ReportedSteps found;
    BlockNumbers blocks;
    for (std::size_t index = 0; index < robot.trajectories.size(); ++index)
        if (const SensorLog* const own = findSensor(robot.trajectories[index], sensor))
            addSteps(found.steps, found.misfits, blocks, index, robot.trajectories[index], own->poses);
    return found;
}

std::optional<Pose> trueMotion(const ReportedStep& step, double lateness) {
    const auto from = poseAt(*step.trajectory, step.begin - fromSeconds(lateness));
    const auto to = poseAt(*step.trajectory, step.end - fromSeconds(lateness));
    if (!from || !to) return std::nullopt;
    return relative(*from, *to);
}

/// What was reported of one coordinate, beside the truth.
struct StepPairs {
    std::vector<double> reported, truth;
    std::vector<std::int32_t> blocks;
};

void centreOn(std::vector<double>& values) {
    const double middle = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    for (double& value : values) value -= middle;
}

/// By least squares. Jumps count as the largest that noise and motion would explain.
FollowedMotion slopeOf(StepPairs pairs, double leastMotion) {
    constexpr std::size_t fewest = 100;
    if (pairs.truth.size() < fewest) return {};
    centreOn(pairs.truth);
    double most = 0, squares = 0, products = 0;
    for (const double motion : pairs.truth) most = std::max(most, std::abs(motion)), squares += motion * motion;
    if (squares < leastMotion * leastMotion * static_cast<double>(pairs.truth.size())) return {};
    const double middle = medianOf(pairs.reported);
    const double limit = std::max(2 * most, 4 * robustSpread(pairs.reported, middle));
    for (double& motion : pairs.reported) motion = std::clamp(motion - middle, -limit, limit);
    centreOn(pairs.reported);
    for (std::size_t i = 0; i < pairs.truth.size(); ++i) products += pairs.truth[i] * pairs.reported[i];
    const double share = products / squares;
    std::map<std::int32_t, double> blocks;
    for (std::size_t i = 0; i < pairs.truth.size(); ++i)
        blocks[pairs.blocks[i]] += pairs.truth[i] * (pairs.reported[i] - share * pairs.truth[i]);
    double sum = 0;
    for (const auto& [block, off] : blocks) sum += off * off;
    return {share, blocks.size() < 2 ? INFINITY : std::sqrt(sum) / squares};
}

}  // namespace

std::vector<KnownReading> knownReadings(const Log& log, const RobotLog& robot, const std::string& sensor) {
    std::vector<KnownReading> known;
    for (std::size_t index = 0; index < robot.trajectories.size(); ++index)
        if (const SensorLog* const own = findSensor(robot.trajectories[index], sensor))
            for (const Look& look : own->looks) addKnown(known, log, robot.trajectories[index], index, look);
    return known;
}

std::optional<ReadingMisfit> misfitOf(const KnownReading& known, double lateness) {
    const Nanoseconds time = known.time - fromSeconds(lateness);
    const auto pose = poseAt(*known.robot, time);
    if (!pose) return std::nullopt;
    Point place = known.landmark;
    if (known.subject != nullptr) {
        const auto other = poseAt(*known.subject, time);
        if (!other) return std::nullopt;
        place = position(*other);
    }
    const Point way = place - position(*pose);
    return ReadingMisfit{known.reading.range - length(way),
                         wrapAngle(known.reading.bearing - (direction(way) - pose->heading))};
}

LateMisfits bearingMisfits(const std::vector<KnownReading>& readings) {
    LateMisfits misfits;
    BlockNumbers blocks;
    for (const KnownReading& known : readings) misfits.blocks.push_back(blocks.of(known.trajectory, known.time));
    misfits.kinds.resize(readings.size());
    misfits.at = [&readings](double lateness) {
        std::vector<double> values;
        values.reserve(readings.size());
        for (const KnownReading& known : readings) {
            const auto misfit = misfitOf(known, lateness);
            values.push_back(misfit ? misfit->bearing : absent);
        }
        return values;
    };
    return misfits;
}

LateMisfits motionMisfits(const RobotLog& robot, const std::string& sensor) {
    ReportedSteps found = reportedSteps(robot, sensor);
    LateMisfits misfits = std::move(found.misfits);
    misfits.at = [steps = std::make_shared<std::vector<ReportedStep>>(std::move(found.steps))](double lateness) {
        std::vector<double> values;
        values.reserve(2 * steps->size());
        for (const ReportedStep& step : *steps) {
            const Pose moved = trueMotion(step, lateness).value_or(Pose{absent, absent, absent});
            values.push_back(step.moved.heading - moved.heading);
            values.push_back(step.moved.x - moved.x);
        }
        return values;
    };
    return misfits;
}

FollowedMotion followedMotion(const RobotLog& robot, const std::string& sensor, double lateness) {
    constexpr double leastTurn = 0.02, leastWay = 0.01;  // rad, m: less is the tracker's noise
    constexpr double leastError = 1e-6;
    const ReportedSteps found = reportedSteps(robot, sensor);
    StepPairs turns, ways;
    for (std::size_t i = 0; i < found.steps.size(); ++i) {
        const auto truth = trueMotion(found.steps[i], lateness);
        if (!truth) continue;
        const auto add = [&](StepPairs& to, double reported, double motion) {
            to.reported.push_back(reported);
            to.truth.push_back(motion);
            to.blocks.push_back(found.misfits.blocks[2 * i]);
        };
        add(turns, found.steps[i].moved.heading, truth->heading);
        add(ways, found.steps[i].moved.x, truth->x);
    }
    double weights = 0, sum = 0;
    for (const FollowedMotion& slope : {slopeOf(std::move(turns), leastTurn), slopeOf(std::move(ways), leastWay)}) {
        const double error = std::max(slope.error, leastError), weight = 1 / (error * error);
        weights += weight;
        sum += weight * slope.share;
    }
    return weights > 0 ? FollowedMotion{sum / weights, 1 / std::sqrt(weights)} : FollowedMotion{};
}

PoseMisfit poseMisfit(const RobotLog& robot, const std::string& sensor, double lateness) {
    std::vector<double> distances, headings, exchanged, motions;
    for (const Trajectory& trajectory : robot.trajectories) {
        const SensorLog* const own = findSensor(trajectory, sensor);
        if (own == nullptr) continue;
        for (const StampedPose& reported : own->poses) {
            const Nanoseconds time = reported.time - fromSeconds(lateness);
            const auto truth = poseAt(trajectory, time);
            if (!truth) continue;
            const Pose& pose = reported.pose;
            distances.push_back(distance(position(pose), position(*truth)));
            exchanged.push_back(distance({pose.y, pose.x}, position(*truth)));
            headings.push_back(std::abs(wrapAngle(pose.heading - truth->heading)));
            if (const auto before = poseAt(trajectory, time - nanosecondsPerSecond))
                motions.push_back(distance(position(*before), position(*truth)));
        }
    }
    if (motions.empty()) return {};
    return {distances.size(), medianOf(distances), medianOf(headings), medianOf(exchanged), medianOf(motions)};
}

std::vector<StampedMisfit> courseMisfits(const std::vector<StampedPose>& poses) {
    constexpr Nanoseconds half = nanosecondsPerSecond / 2;
    constexpr double shortestWay = 0.05, largestTurn = 0.2;  // m, rad
    std::vector<StampedMisfit> misfits;
    if (poses.empty()) return misfits;
    for (Nanoseconds time = poses.front().time + half; time + half < poses.back().time; time += half) {
        if (!truthIsKnown(poses, time - half) || !truthIsKnown(poses, time) || !truthIsKnown(poses, time + half))
            continue;
        const Pose from = truthAt(poses, time - half), to = truthAt(poses, time + half);
        const Point way = position(to) - position(from);
        if (length(way) < shortestWay || std::abs(to.heading - from.heading) > largestTurn) continue;
        // Of an arc, the chord's direction is that of the heading half way.
        double off = wrapAngle(direction(way) - truthAt(poses, time).heading);
        if (std::abs(off) > std::numbers::pi / 2) off = wrapAngle(off + std::numbers::pi);
        misfits.push_back({time, off});
    }
    return misfits;
}

}  // namespace mrose
