#include "logs/log_lookup.h"

#include <algorithm>

namespace mrose {

const Trajectory* trajectoryBeside(const Trajectory& own, const RobotLog& other) {
    const auto found = std::ranges::find(other.trajectories, own.name, &Trajectory::name);
    if (found != other.trajectories.end()) return &*found;
    return other.trajectories.size() == 1 ? &other.trajectories.front() : nullptr;
}

const SensorLog* findSensor(const Trajectory& trajectory, std::string_view name) {
    const auto found = std::ranges::find(trajectory.sensors, name, &SensorLog::sensor);
    return found == trajectory.sensors.end() ? nullptr : &*found;
}

bool hasLooks(const RobotLog& robot, std::string_view sensor) {
    return std::ranges::any_of(robot.trajectories, [&](const Trajectory& trajectory) {
        const SensorLog* const found = findSensor(trajectory, sensor);
        return found != nullptr && !found->looks.empty();
    });
}

std::vector<std::string> sensorNames(const Log& log) {
    std::vector<std::string> names;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories)
            for (const SensorLog& sensor : trajectory.sensors)
                if (std::ranges::find(names, sensor.sensor) == names.end()) names.push_back(sensor.sensor);
    return names;
}

}  // namespace mrose
