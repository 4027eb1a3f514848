#include "identification/drive_fit.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/point.h"

namespace mrose {
namespace {

constexpr double shortestPath = 0.02;  // m
constexpr Nanoseconds pathStep = 95'000'000;

double pathLength(const std::vector<StampedPose>& poses) {
    double path = 0;
    std::size_t last = 0;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        if (poses[i].time - poses[last].time < pathStep) continue;
        path += distance(position(poses[last].pose), position(poses[i].pose));
        last = i;
    }
    return path;
}

/// Mean body velocity that the wheels had, or were commanded, between two instants.
Command meanVelocity(const Trajectory& trajectory, WheelSource source, Nanoseconds begin, Nanoseconds end) {
    Command sum;
    double count = 0;
    const auto take = [&](Nanoseconds time, double v, double w) {
        if (time < begin || time > end) return;
        sum.v += v;
        sum.w += w;
        ++count;
    };
    if (source == WheelSource::commands)
        for (const auto& item : trajectory.commands) take(item.time, item.command.v, item.command.w);
    else
        for (const auto& item : trajectory.measuredVelocity) take(item.time, item.velocity.v, item.velocity.w);
    return count > 0 ? Command{sum.v / count, sum.w / count} : Command{};
}

struct Sums {
    double sumTwist = 0, sumSquare = 0, differenceTwist = 0, differenceSquare = 0;

    void add(const SteadyMotion& motion) {
        const Twist twist = log(motion.end);
        const double sum = (motion.wheels.left + motion.wheels.right) / 2;
        const double difference = motion.wheels.right - motion.wheels.left;
        sumTwist += sum * twist.x / motion.duration;
        sumSquare += sum * sum;
        differenceTwist += difference * twist.rotation / motion.duration;
        differenceSquare += difference * difference;
    }
    bool sufficient() const { return sumTwist > 0 && differenceTwist > 0; }
    DifferentialDrive drive() const {
        const double radius = sumTwist / sumSquare;
        return {radius, radius * differenceSquare / differenceTwist};
    }
};

}  // namespace

std::vector<SteadyMotion> steadyMotions(const Log& log, WheelSource source, const DifferentialDrive& readWith) {
    std::vector<SteadyMotion> motions;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            const auto& poses = trajectory.poses;
            if (!trajectory.steady || poses.size() < 2) continue;
            const Nanoseconds begin = poses.front().time, end = poses.back().time;
            SteadyMotion motion;
            motion.wheels = readWith.toWheels(meanVelocity(trajectory, source, begin, end));
            motion.duration = toSeconds(end - begin);
            motion.end = relative(poses.front().pose, poses.back().pose);
            motion.path = pathLength(poses);
            motion.group = trajectory.group;
            if (motion.path >= shortestPath) motions.push_back(motion);
        }
    return motions;
}

Expected<DriveFit> fitDrive(const std::vector<SteadyMotion>& motions, const std::string& source) {
    if (motions.size() < 3) return fail(source, "fewer than 3 stretches of steady motion");
    Sums all;
    std::set<int> groups;
    for (const SteadyMotion& motion : motions) {
        all.add(motion);
        groups.insert(motion.group);
    }
    if (!all.sufficient()) return fail(source, "the wheels do not both drive and turn the robot");
    DriveFit fit{all.drive(), 0, 0, motions.size()};
    double radius = 0, track = 0;
    for (const int left : groups) {
        Sums rest;
        for (const SteadyMotion& motion : motions)
            if (motion.group != left) rest.add(motion);
        if (!rest.sufficient()) continue;
        const double radiusOff = rest.drive().wheelRadius - fit.drive.wheelRadius,
                     trackOff = rest.drive().track - fit.drive.track;
        radius += radiusOff * radiusOff;
        track += trackOff * trackOff;
    }
    const double count = static_cast<double>(groups.size());
    fit.wheelRadiusError = std::sqrt((count - 1) / count * radius);
    fit.trackError = std::sqrt((count - 1) / count * track);
    return fit;
}

}  // namespace mrose
