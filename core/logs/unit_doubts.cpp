#include "logs/unit_doubts.h"

#include <cmath>
#include <cstdio>

#include "geometry/point.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

constexpr Nanoseconds shortTime = truthGap / 2;   // noise is small beside what happens meanwhile
constexpr double fastest = 50, fastestTurn = 20;  // m/s, rad/s: no mobile robot is
constexpr double seldom = 0.05;                   // share of the time that trackers may err

/// What is known of neighbouring poses of all robots.
struct Motion {
    std::int64_t steps = 0, far = 0;  ///< `far`: nothing is known between
    double seconds = 0;               ///< of all steps
    std::int64_t spans = 0, fast = 0, fastTurns = 0;

    void add(const std::vector<StampedPose>& poses);
};

void Motion::add(const std::vector<StampedPose>& poses) {
    for (std::size_t i = 1, from = 0; i < poses.size(); ++i) {
        const Nanoseconds step = poses[i].time - poses[i - 1].time;
        ++steps;
        far += step >= truthGap;
        seconds += toSeconds(step);
        if (step >= truthGap) from = i;
        if (poses[i].time - poses[from].time < shortTime) continue;
        const double time = toSeconds(poses[i].time - poses[from].time);
        const Pose &a = poses[from].pose, &b = poses[i].pose;
        ++spans;
        fast += distance(position(a), position(b)) > fastest * time;
        fastTurns += std::abs(b.heading - a.heading) > fastestTurn * time;
        from = i;
    }
}

std::string shortText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace

std::vector<std::string> unitDoubts(const Log& log) {
    if (log.format != "csv") return {};
    Motion motion;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) motion.add(trajectory.poses);
    std::vector<std::string> doubts;
    if (motion.steps > 0 && motion.far == motion.steps)
        doubts.push_back("The poses of the log are " + shortText(motion.seconds / static_cast<double>(motion.steps)) +
                         " s apart, so that no rollout can be compared: times are expected in seconds.");
    const auto often = [&](std::int64_t count) {
        return static_cast<double>(count) > seldom * static_cast<double>(motion.spans);
    };
    if (often(motion.fast))
        doubts.push_back("The real robots would drive at more than " + shortText(fastest) +
                         " m/s: positions are expected in metres, times in seconds.");
    if (often(motion.fastTurns))
        doubts.push_back("The real robots would turn by more than " + shortText(fastestTurn) +
                         " rad/s: headings are expected in radians, not in degrees.");
    return doubts;
}

}  // namespace mrose
