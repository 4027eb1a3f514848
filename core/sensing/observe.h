#pragma once

#include <cstddef>

#include "control/observation.h"
#include "scenario/scenario.h"
#include "sensing/sensing_buffers.h"

namespace mrose {

/// What robot `robot` perceives at the tick of `state`, by its type's Perception and the counter-based noise, as far as
/// its controller reads it. `memory` is the robot's SensorMemory, as it was before and as it becomes, which does not
/// depend on that; `out` is filled anew.
void observe(const Scenario& scenario, const WorldState& state, std::size_t robot, SensorMemory& memory,
             SensingBuffers& buffers, Observation& out);

}  // namespace mrose
