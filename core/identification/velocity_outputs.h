#pragma once

#include "identification/motion_samples.h"
#include "motion/motion_network.h"

namespace mrose {

/// Completes a network of the history form, whose layers give the increments, by the velocities at the period's start
/// and end: linear least squares on its hidden units, which stay as they are. Before: three outputs; after: seven.
void addVelocityOutputs(const MotionSamples& samples, MotionNetwork& network);

}  // namespace mrose
