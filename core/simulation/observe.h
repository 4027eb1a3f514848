#pragma once

#include <cstddef>

#include "control/observation.h"
#include "scenario/scenario.h"
#include "sensing/sensing_buffers.h"

namespace mrose {

/// What robot `robot` perceives at the tick of `state`: the readings of its sensors that have arrived since its last
/// control instant, as far as its controller reads them. `memory` is what its sensors remember
/// (Scenario::sensorMemory), as it was before and as it becomes; `out` is filled anew.
void observe(const Scenario& scenario, const WorldState& state, std::size_t robot, std::span<std::byte> memory,
             SensingBuffers& buffers, Observation& out);

/// The rest of what its type's own sensors give: what its controller does not read, or, where it is not asked, all.
void observeUnread(const Scenario& scenario, const WorldState& state, std::size_t robot, bool asked,
                   SensingBuffers& buffers, Observation& out);

}  // namespace mrose
