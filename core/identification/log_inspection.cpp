#include "identification/log_inspection.h"

#include <algorithm>

#include "learning/parallel_for.h"
#include "logs/unit_doubts.h"

namespace mrose {
namespace {

double rate(std::size_t samples, std::size_t trajectories, double time) {
    return time > 0 && samples > trajectories ? static_cast<double>(samples - trajectories) / time : 0;
}

RobotInspection inspectRobot(const RobotLog& robot, const DeadTimes& delays) {
    RobotInspection found;
    found.robot = robot.robot;
    found.trajectories = robot.trajectories.size();
    found.defects = robot.defects;
    found.delays = delays;
    for (const Trajectory& t : robot.trajectories) {
        found.commands += t.commands.size();
        found.poses += t.poses.size();
        if (!t.commands.empty()) found.commandTime += toSeconds(t.commands.back().time - t.commands.front().time);
        if (!t.poses.empty()) found.poseTime += toSeconds(t.poses.back().time - t.poses.front().time);
        for (const StampedCommand& c : t.commands) {
            found.v.add(c.command.v);
            found.w.add(c.command.w);
        }
        for (const StampedPose& p : t.poses) {
            found.x.add(p.pose.x);
            found.y.add(p.pose.y);
        }
        found.ball += t.ball.size();
        if (!t.ball.empty()) found.ballTime += toSeconds(t.ball.back().time - t.ball.front().time);
        found.kicks += t.kicks.size();
        for (const StampedKick& kick : t.kicks) found.kickPower.add(kick.power);
    }
    return found;
}

}  // namespace

void MeasuredRange::add(double x) {
    least = std::min(least, x);
    most = std::max(most, x);
}

double RobotInspection::commandRate() const { return rate(commands, trajectories, commandTime); }
double RobotInspection::poseRate() const { return rate(poses, trajectories, poseTime); }
double RobotInspection::ballRate() const { return rate(ball, trajectories, ballTime); }

bool LogInspection::hasMeasurements() const {
    return std::any_of(robots.begin(), robots.end(),
                       [](const RobotInspection& robot) { return !robot.sensors.empty(); });
}

LogInspection inspect(const Log& log) {
    LogInspection found{log.source, log.format, log.synthetic, log.files, log.incomplete, unitDoubts(log), {}};
    const std::vector<DeadTimes> delays = identifyEachDeadTime(log);
    for (std::size_t i = 0; i < log.robots.size(); ++i) found.robots.push_back(inspectRobot(log.robots[i], delays[i]));
    found.measurementFiles = log.measurementFiles;
    parallelFor(log.robots.size(),
                [&](std::size_t i) { found.robots[i].sensors = inspectSensors(log, log.robots[i]); });
    return found;
}

std::span<const DefectCount> defectCounts() {
    static constexpr DefectCount counts[] = {
        {&LogDefects::outOfOrder, "out_of_order", "stamp", "stamps", " out of order, sorted"},
        {&LogDefects::duplicates, "duplicates", "equal stamp", "equal stamps", ", last kept"},
        {&LogDefects::blips, "blips", "blip", "blips", " (single zero commands), dropped"},
        {&LogDefects::poseOutliers, "pose_outliers", "pose outlier", "pose outliers", ", dropped"},
        {&LogDefects::ballOutliers, "ball_outliers", "outlier", "outliers", " of the ball, dropped"},
        {&LogDefects::unpaired, "unpaired", "value", "values", " without a partner, dropped"},
        {&LogDefects::headingWraps, "heading_wraps", "heading wrap", "heading wraps", ", unwrapped"},
        {&LogDefects::cutLines, "cut_lines", "last line", "last lines", " cut off, left out"},
        {&LogDefects::commandGaps, "command_gaps", "gap", "gaps", " in the commands"},
        {&LogDefects::poseGaps, "pose_gaps", "gap", "gaps", " in the poses"},
        {&LogDefects::ballGaps, "ball_gaps", "gap", "gaps", " in the ball's positions"}};
    return counts;
}

}  // namespace mrose
