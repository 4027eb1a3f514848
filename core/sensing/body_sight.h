#pragma once

#include <vector>

#include "control/observation.h"
#include "sensing/observer.h"

namespace mrose {

/// The other robots that the observer sees now, as they were at its sensor's latency ago, in its own frame of then.
/// `bearingBias` is SensorMemory's.
void seeRobots(const Observer& observer, double bearingBias, std::vector<SeenBody>& seen);

/// Likewise the objects.
void seeObjects(const Observer& observer, double bearingBias, std::vector<SeenBody>& seen);

}  // namespace mrose
