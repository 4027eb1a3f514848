#include "scenario/obstacle_sensors.h"

#include <algorithm>
#include <optional>

#include "control/sensor_records.h"
#include "sensing/infrared_ring.h"

namespace mrose {
namespace {

constexpr double surelyMore = 4;  // standard deviations of an infrared element's noise

std::optional<ObstacleSensor> obstacleSensor(const Sensor& sensor, const RobotType& robot) {
    using Kind = ObstacleSensor::Kind;
    const std::vector<SensorElement> elements = sensor.elements();
    const std::vector<ReadingKind> readings = sensor.gives();
    if (elements.empty() || readings.empty()) return std::nullopt;
    ObstacleSensor found{Kind::laser, readings[0].name, {}, elements[0].halfWidth, elements[0].range};
    for (const SensorElement& element : elements) found.elements.push_back(element.mount);
    if (*readings[0].type == recordType<RangeEcho>()) {
        if (found.halfWidth > 0) found.kind = Kind::sonar;
        return found;
    }
    if (*readings[0].type == recordType<BumperContact>()) {
        found.kind = Kind::bumpers;
        found.range = robot.shape->reach;
        return found;
    }
    const auto* const infrared = dynamic_cast<const InfraredRing*>(&sensor);
    if (infrared == nullptr) return std::nullopt;
    const InfraredRing::Options& light = infrared->options();
    const double farthest = light.reference / light.range;
    found.kind = Kind::infrared;
    found.reference = light.reference;
    found.ambient = light.ambient;
    found.leastIntensity = std::max(surelyMore * light.noise, farthest * farthest);
    return found;
}

}  // namespace

std::vector<ObstacleSensor> obstacleSensors(const RobotType& robot) {
    std::vector<ObstacleSensor> sensors;
    for (const auto& sensor : robot.sensors)
        if (auto found = obstacleSensor(*sensor, robot)) sensors.push_back(std::move(*found));
    std::ranges::stable_sort(sensors, {}, &ObstacleSensor::kind);
    return sensors;
}

}  // namespace mrose
