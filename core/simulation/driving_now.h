#pragma once

#include <cstddef>

#include "motion/driving_reader.h"
#include "scenario/scenario.h"

namespace mrose {

/// What says how unfamiliar a robot's driving is to the network that moves it; null where it is moved otherwise, or by
/// a network whose file does not say where it learned.
const DrivingReader* familiarDriving(const Scene& scene, std::size_t robot);

/// What a robot's motion model would see if a period began now, without its memory.
MotionInput drivingNow(const Scenario& scenario, const WorldState& state, std::size_t robot);

}  // namespace mrose
