#include "sensing/sensor_kinds.h"

#include <algorithm>
#include <set>

#include "sensing/body_sight.h"
#include "sensing/odometry.h"
#include "sensing/self_localisation.h"
#include "sensing/sensor_keys.h"

namespace mrose {

Perception readPerception(TomlTable table) {
    Perception perception;
    perception.self = readSelfLocalisation(table.tableOrEmpty("self"));
    perception.objects = readBodySight(table.tableOrEmpty("objects"));
    perception.robots = readBodySight(table.tableOrEmpty("robots"));
    perception.velocityNoise = table.numberOr("velocity_noise_mps", 0, metresOff);
    perception.rotationNoise = angleOr(table, "rotation_noise_degps", 0, degreesOff);
    table.rejectUnknown();
    return perception;
}

std::vector<SensorPointer> standardSensors(const Perception& perception) {
    return {std::make_shared<const SelfLocaliser>(perception.self),
            std::make_shared<const BodySensor>(perception.robots, perception.objects, perception.self.biasTime),
            std::make_shared<const Odometry>(perception.velocityNoise, perception.rotationNoise)};
}

}  // namespace mrose
