#pragma once

#include "sensing/observer.h"

namespace mrose {

/// Lets the biases of the observer's sensors drift by a control period: a first-order autoregressive process in its
/// exact discretisation, stationary from the first period on.
void driftBiases(const Observer& observer, SensorMemory& memory);

/// The measurement of the own pose that arrives now, if one does; otherwise the last one stays.
void localise(const Observer& observer, SensorMemory& memory);

}  // namespace mrose
