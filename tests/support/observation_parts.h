#pragma once

#include <vector>

#include "control/observation.h"

namespace mrose {

/// What an observation of the sensors that every robot has is made of, for tests that make it up.
struct ObservationParts {
    std::uint32_t robot = 0, manipulators = 0;
    Nanoseconds time = 0;
    std::uint64_t noise = 0;
    bool localised = false;
    Pose self;
    Nanoseconds selfMeasured = 0;
    Velocity velocity;
    std::vector<SeenBody> robots, objects;

    operator Observation() const {
        Observation whole;
        whole.robot = robot;
        whole.manipulators = manipulators;
        whole.time = time;
        whole.noise = noise;
        if (localised) whole.add(selfReading, selfMeasured, self);
        whole.add(robotsReading, time, std::span<const SeenBody>(robots));
        whole.add(objectsReading, time, std::span<const SeenBody>(objects));
        whole.add(odometryReading, time, velocity);
        return whole;
    }
};

}  // namespace mrose
