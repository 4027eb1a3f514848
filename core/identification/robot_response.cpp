#include "identification/robot_response.h"

#include <algorithm>
#include <optional>

#include <oneapi/tbb/parallel_for.h>

#include "identification/kinematic_fit.h"

namespace mrose {
namespace {

struct NamedRobot {
    std::string source;  ///< of the first log that it occurs in
    RobotLog log;
};

std::vector<NamedRobot> robotsOf(std::span<const Log> logs) {
    std::vector<NamedRobot> robots;
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots) {
            const auto known = std::find_if(robots.begin(), robots.end(),
                                            [&](const NamedRobot& item) { return item.log.robot == robot.robot; });
            if (known == robots.end()) {
                robots.push_back({log.source, robot});
                continue;
            }
            auto& trajectories = known->log.trajectories;
            trajectories.insert(trajectories.end(), robot.trajectories.begin(), robot.trajectories.end());
        }
    return robots;
}

Expected<MotionNetwork::Identified> identifyRobot(const NamedRobot& robot) {
    const std::span<const RobotLog> alone(&robot.log, 1);
    const auto kinematics = fitKinematics(alone, KinematicBaseline::dynamic, robot.source);
    if (!kinematics) return tl::unexpected(kinematics.error());
    const DeadTimes delays = identifyDeadTimes(alone);
    MotionNetwork::Identified identified;
    identified.robot = robot.log.robot;
    identified.kinematics = *kinematics;
    identified.deadTimeErrorV = delays.v.identifiable ? delays.v.deadTimeError : 0;
    identified.deadTimeErrorW = delays.w.identifiable ? delays.w.deadTimeError : 0;
    return identified;
}

bool hasMeasuredWheels(const Log& log) {
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories)
            if (!trajectory.measuredVelocity.empty()) return true;
    return false;
}

}  // namespace

RobotResponse identifyResponse(const RobotLog& robot) { return identifyDeadTimes({&robot, 1}); }

Expected<std::vector<MotionNetwork::Identified>> identifyRobots(std::span<const Log> logs) {
    const std::vector<NamedRobot> robots = robotsOf(logs);
    std::vector<std::optional<Expected<MotionNetwork::Identified>>> found(robots.size());
    tbb::parallel_for(std::size_t{0}, robots.size(), [&](std::size_t i) { found[i] = identifyRobot(robots[i]); });
    std::vector<MotionNetwork::Identified> identified;
    for (const auto& robot : found) {
        if (!*robot) return tl::unexpected(robot->error());
        identified.push_back(**robot);
    }
    return identified;
}

Expected<DriveFit> fitDrive(const Log& log) {
    const WheelSource source = hasMeasuredWheels(log) ? WheelSource::measured : WheelSource::commands;
    return fitDrive(steadyMotions(log, source), log.source);
}

}  // namespace mrose
