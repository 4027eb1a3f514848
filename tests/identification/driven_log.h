#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "logs/robot_log.h"
#include "motion/motion_model.h"
#include "support/units.h"
#include "synthetic/log_generator.h"
#include "world/noise.h"

namespace mrose {

/// A robot that follows `model` exactly, driven by random commands; poses every 20 ms.
inline Log drivenLog(const MotionModel& model, int trajectories, double seconds, std::uint64_t seed) {
    Log log;
    log.source = "planted";
    RobotLog robot{"1", {}, {}};
    for (int t = 0; t < trajectories; ++t) {
        Trajectory trajectory;
        trajectory.name = std::to_string(t);
        trajectory.group = t;
        CommandHistory history;
        Pose pose;
        Velocity velocity;
        Command command;
        for (std::int64_t tick = 0; tick < static_cast<std::int64_t>(seconds * 50); ++tick) {
            const Nanoseconds time = tick * 20 * ms;
            if (tick % 5 == 0) {
                const NoiseKey key{seed, tick, static_cast<std::uint32_t>(t), 0};
                if (uniformNoise(key) < 0.15)
                    command = {0.5 * uniformNoise({seed, tick, key.robot, 1}),
                               0.8 * normalNoise({seed, tick, key.robot, 2})};
                history.issue(time, command);
                trajectory.commands.push_back({time, command});
            }
            trajectory.poses.push_back({time, pose});
            const MotionStep step = model.predictOne({&history, time, velocity});
            pose = pose * step.increment;
            velocity = step.velocity;
        }
        robot.trajectories.push_back(std::move(trajectory));
    }
    log.robots.push_back(std::move(robot));
    return log;
}

/// The reference robot, driven at random, but turning no faster than `fastest` rad/s.
inline Log drivenReference(double fastest, int trajectories, std::uint64_t seed) {
    Log log;
    log.robots.push_back({"reference", {}, {}});
    for (int t = 0; t < trajectories; ++t) {
        constexpr double duration = 30;
        Trajectory trajectory;
        trajectory.name = std::to_string(t);
        trajectory.group = t;
        trajectory.commands = patternCommands(DrivePattern::random, duration, seed, std::uint32_t(t));
        for (StampedCommand& issued : trajectory.commands)
            issued.command.w = std::clamp(issued.command.w, -fastest, fastest);
        trajectory.poses = runReferenceRobot(trajectory.commands, duration, {}, seed + std::uint64_t(t)).tracked;
        log.robots.front().trajectories.push_back(std::move(trajectory));
    }
    return log;
}

}  // namespace mrose
