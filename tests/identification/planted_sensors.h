#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "geometry/point.h"
#include "logs/robot_log.h"
#include "world/noise.h"

namespace mrose {

/// A robot on a closed curve, whose pose is known at every instant, with sensors whose faults are known: what the
/// inspection must find.
struct PlantedSensors {
    double lateness = 0.04, period = 0.2;  ///< s
    double seconds = 280;
    double bearingNoise = 0.005, rangeNoise = 0.02;  ///< standard deviations of readings, rad and m
    double headingNoise = 0.001;                     ///< of the tracker
    double drives = INFINITY;                        ///< s from which on it stands
    bool turns = true;
    std::function<double(double seconds)> bearingOffset = [](double) { return 0.0; };
    std::function<double(double seconds)> headingOffset = [](double) { return 0.0; };
    std::function<double(double seconds)> rangeFactor = [](double) { return 1.0; };
    std::uint64_t seed = 1;
};

namespace planted {

constexpr Nanoseconds sensorOrigin = 1'700'000'000 * nanosecondsPerSecond;

inline Pose curve(const PlantedSensors& plant, double seconds) {
    const double t = std::min(seconds, plant.drives);
    if (!plant.turns) return {0.01 * t - 2, 0.5, 0};
    const double heading = std::atan2(0.315 * std::cos(0.21 * t + 1), 0.26 * std::cos(0.13 * t));
    return {2 * std::sin(0.13 * t), 1.5 * std::sin(0.21 * t + 1), heading};
}

inline Nanoseconds instant(double seconds) { return sensorOrigin + fromSeconds(seconds); }

inline const std::vector<LogSubject>& landmarks() {
    static const std::vector<LogSubject> all = [] {
        std::vector<LogSubject> found;
        for (int i = 0; i < 8; ++i) {
            const double angle = 0.785 * i + 0.3;
            found.push_back({.name = std::to_string(i), .position = Point{4 * std::cos(angle), 4 * std::sin(angle)}});
        }
        return found;
    }();
    return all;
}

}  // namespace planted

inline Trajectory plantedSensorTrajectory(const PlantedSensors& plant) {
    using namespace planted;
    const auto noise = [&](std::int64_t i, std::uint32_t channel) { return normalNoise({plant.seed, i, 0, channel}); };
    Trajectory trajectory{.name = "whole"};
    double before = 0;
    std::int64_t count = 0;
    for (double t = 0; t <= plant.seconds; t += 0.02, ++count) {
        Pose pose = curve(plant, t);
        pose.heading = before = before + wrapAngle(pose.heading - before);
        pose.heading += plant.headingOffset(t) + plant.headingNoise * noise(count, 0);
        trajectory.poses.push_back({instant(t), pose});
    }
    SensorLog camera{.sensor = "camera"}, slam{.sensor = "slam"};
    // Its frame is not the truth's, and its heading drifts.
    const Pose frame{7, -3, 2};
    for (double t = 1; t <= plant.seconds - 1; t += plant.period, ++count) {
        const Pose pose = curve(plant, t - plant.lateness);
        Look& look = camera.looks.emplace_back(Look{instant(t), {}});
        for (std::uint32_t i = 0; i < landmarks().size(); ++i) {
            const Point way = *landmarks()[i].position - position(pose);
            const double bearing = wrapAngle(std::atan2(way.y, way.x) - pose.heading);
            if (std::abs(bearing) > 0.7) continue;
            look.readings.push_back({i, plant.rangeFactor(t) * length(way) + plant.rangeNoise * noise(count, 2 * i + 1),
                                     bearing + plant.bearingOffset(t) + plant.bearingNoise * noise(count, 2 * i + 2)});
        }
        Pose reported = frame * pose;
        reported.x += 0.2 * plant.rangeNoise * noise(count, 29);
        reported.y += 0.2 * plant.rangeNoise * noise(count, 30);
        reported.heading += 1e-4 * t + plant.bearingNoise * noise(count, 31);
        if (!slam.poses.empty())
            reported.heading =
                slam.poses.back().pose.heading + wrapAngle(reported.heading - slam.poses.back().pose.heading);
        slam.poses.push_back({instant(t), reported});
    }
    trajectory.sensors = {camera, slam};
    return trajectory;
}

inline Log plantedSensorLog(const PlantedSensors& plant) {
    Log log;
    log.format = "csv";
    log.subjects = planted::landmarks();
    log.robots.push_back({"a", {plantedSensorTrajectory(plant)}, {}});
    return log;
}

}  // namespace mrose
