#pragma once

#include "scenario/scenario.h"

namespace mrose {

/// Every robot, network, outline and built-in controller that ships, in a field so small that they keep colliding, with
/// a ball and two boxes. Without `noise` the models alone say how robots move, and all are told random speeds.
Scenario shippedCrowd(bool noise);

}  // namespace mrose
