#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "logs/robot_log.h"
#include "world/noise.h"

namespace mrose {

/// A robot that obeys a known law, simulated in steps of 1 ms: what identification must find.
struct Plant {
    double deadTimeV = 0.2, deadTimeW = 0.2;  ///< s, mean
    double lagV = 0, lagW = 0;                ///< s
    double jitter = 0.02;                     ///< s, standard deviation of each command's own dead time
    double gain = 0.9, biasW = 0.02;          ///< of the static map, while a command moves the robot
    double scrub = 0;                         ///< v is multiplied by 1 - scrub |w|
    double positionNoise = 0.002, headingNoise = 0.004;
    double duration = 300;  ///< s
    bool drives = true, turns = true;
    double resting = 0;  ///< s without truth in the middle
    std::uint64_t seed = 1;
};

namespace planted {

constexpr double origin = 1.7e9;  // stamps like those of real logs

struct Effect {
    double time, value;
};

inline double at(const std::vector<Effect>& effects, double time, std::size_t& index) {
    while (index + 1 < effects.size() && effects[index + 1].time <= time) ++index;
    return effects.empty() || effects[index].time > time ? 0 : effects[index].value;
}

/// Stamps in steps of 10 ms, as those of a log that was written by a polling loop.
inline Nanoseconds quantised(double time) { return fromSeconds(origin) + std::llround(time * 100) * 10'000'000; }

}  // namespace planted

/// Mean of a normal dead time that is cut at 0: a command never acts before it is issued.
inline double meanDelay(double deadTime, double jitter) {
    if (jitter <= 0) return deadTime;
    const double z = deadTime / jitter;
    return deadTime * std::erfc(-z / std::sqrt(2.0)) / 2 +
           jitter * std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
}

inline Trajectory plantedTrajectory(const Plant& plant) {
    Trajectory trajectory;
    trajectory.name = "planted";
    std::vector<planted::Effect> v, w;
    const auto uniform = [&](std::int64_t tick, std::uint32_t channel) {
        return uniformNoise({plant.seed, tick, 0, channel});
    };
    const auto normal = [&](std::int64_t tick, std::uint32_t channel) {
        return normalNoise({plant.seed, tick, 0, channel});
    };
    Command command;
    double holdV = 0, holdW = 0, issue = 0;
    for (std::int64_t i = 0; issue < plant.duration; ++i) {
        const auto late = [&](double deadTime, std::uint32_t channel) {
            return issue + std::max(0.0, deadTime + plant.jitter * normal(i, channel));
        };
        if (issue >= holdV && plant.drives) {
            holdV = issue + 0.3 + 1.7 * uniform(i, 0);
            command.v = uniform(i, 1) < 0.25 ? 0 : 0.4 * (2 * uniform(i, 2) - 0.6);
            v.push_back({late(plant.deadTimeV, 3), command.v});
        }
        if (issue >= holdW && plant.turns) {
            holdW = issue + 0.3 + 1.7 * uniform(i, 4);
            command.w = uniform(i, 5) < 0.25 ? 0 : 3 * uniform(i, 6) - 1.5;
            w.push_back({late(plant.deadTimeW, 7), command.w});
        }
        // The stamp says when the command was issued to 5 ms: the law acts from the true instant.
        const Nanoseconds stamp = planted::quantised(issue);
        if (trajectory.commands.empty() || stamp > trajectory.commands.back().time)
            trajectory.commands.push_back({stamp, command});
        issue += 0.016 + 0.012 * uniform(i, 8);
    }
    Velocity now;
    Pose pose;
    std::size_t atV = 0, atW = 0;
    constexpr double step = 1e-3;
    double nextPose = 0;
    for (std::int64_t i = 0; static_cast<double>(i) * step < plant.duration; ++i) {
        const double time = static_cast<double>(i) * step;
        const double cv = planted::at(v, time, atV), cw = planted::at(w, time, atW);
        const double targetW = cv == 0 && cw == 0 ? 0 : plant.gain * cw + plant.biasW;
        const double targetV = plant.gain * cv * (1 - plant.scrub * std::abs(targetW));
        now.v += (targetV - now.v) * (plant.lagV > 0 ? -std::expm1(-step / plant.lagV) : 1);
        now.w += (targetW - now.w) * (plant.lagW > 0 ? -std::expm1(-step / plant.lagW) : 1);
        if (time >= nextPose) {
            nextPose = time + 0.012 + 0.008 * uniform(i, 9);
            const bool hidden = plant.resting > 0 && std::abs(time - plant.duration / 2) < plant.resting / 2;
            const Pose seen{pose.x + plant.positionNoise * normal(i, 10), pose.y + plant.positionNoise * normal(i, 11),
                            pose.heading + plant.headingNoise * normal(i, 12)};
            if (!hidden) trajectory.poses.push_back({fromSeconds(planted::origin) + fromSeconds(time), seen});
        }
        pose = pose * exp({now.v * step, 0, now.w * step});
    }
    return trajectory;
}

inline RobotLog plantedRobot(const Plant& plant) {
    RobotLog log;
    log.robot = "planted";
    log.trajectories.push_back(plantedTrajectory(plant));
    return log;
}

}  // namespace mrose
