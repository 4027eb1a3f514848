#pragma once

#include "identification/sensor_samples.h"
#include "perception/view.h"

namespace mrose {

/// From where on a sensor sees, m: of the subjects that are ahead and not hidden, hardly any that is nearer is
/// reported, and at least four times as large a share beyond. 0 where that does not show, or too few came so near.
double nearestSeen(const SensorSamples& samples, const View& view);

}  // namespace mrose
