#include "identification/motion_windows.h"

#include <algorithm>
#include <cmath>

#include "geometry/elementary.h"

namespace mrose {
namespace {

constexpr double settling = 1, longestPause = 0.2;  // s

struct MeanPose {
    double time = 0;
    Pose pose;
};

/// Mean of the poses [begin, end), summed as differences from the first one.
MeanPose meanOf(const std::vector<StampedPose>& poses, std::size_t begin, std::size_t end, Nanoseconds origin) {
    const StampedPose& first = poses[begin];
    MeanPose sum;
    for (std::size_t i = begin; i < end; ++i) {
        sum.time += toSeconds(poses[i].time - first.time);
        sum.pose.x += poses[i].pose.x - first.pose.x;
        sum.pose.y += poses[i].pose.y - first.pose.y;
        sum.pose.heading += poses[i].pose.heading - first.pose.heading;
    }
    const double share = 1.0 / static_cast<double>(end - begin);
    return {toSeconds(first.time - origin) + share * sum.time,
            {first.pose.x + share * sum.pose.x, first.pose.y + share * sum.pose.y,
             first.pose.heading + share * sum.pose.heading}};
}

std::vector<MeanPose> pointsOf(const Trajectory& trajectory, double cell, MotionWindows& result) {
    const auto& poses = trajectory.poses;
    const Nanoseconds origin = trajectory.commands.front().time, last = trajectory.commands.back().time;
    std::vector<MeanPose> points;
    result.begin.push_back(0);
    for (std::size_t begin = 0, end = 0; begin < poses.size(); begin = end) {
        const Nanoseconds until = poses[begin].time + fromSeconds(cell);
        for (end = begin + 1; end < poses.size() && poses[end].time < until;) ++end;
        if (poses[begin].time < origin + fromSeconds(settling) || poses[end - 1].time > last) continue;
        points.push_back(meanOf(poses, begin, end, origin));
        for (std::size_t i = begin; i < end; ++i) result.times.push_back(toSeconds(poses[i].time - origin));
        result.begin.push_back(result.times.size());
    }
    return points;
}

/// The chord in the frame of the mean heading; stretched to the arc that has it.
MotionWindows::Window displacement(const Pose& from, const Pose& to) {
    const double rotation = to.heading - from.heading, half = rotation / 2;
    const Pose chord = relative({from.x, from.y, from.heading + half}, to);
    const double arc = std::abs(half) < 1e-6 ? 1 : half / sine(half);
    return {0, 0, arc * chord.x, arc * chord.y, rotation};
}

}  // namespace

MotionWindows motionWindows(const Trajectory& trajectory, double length, double cell) {
    MotionWindows result;
    if (trajectory.commands.empty() || trajectory.poses.empty()) return result;
    const std::vector<MeanPose> points = pointsOf(trajectory, cell, result);
    std::size_t unbroken = 0;  // the first point without a pause up to `to`
    for (std::size_t from = 0, to = 1; to < points.size(); ++to) {
        if (points[to].time - points[to - 1].time >= longestPause) unbroken = to;
        from = std::max(from, unbroken);
        if (points[to].time - points[from].time < length) continue;
        while (points[to].time - points[from + 1].time >= length) ++from;
        MotionWindows::Window window = displacement(points[from].pose, points[to].pose);
        window.from = from++;
        window.to = to;
        if (std::abs(window.rotation) < 2) result.windows.push_back(window);
    }
    return result;
}

}  // namespace mrose
