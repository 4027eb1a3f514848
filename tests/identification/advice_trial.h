#pragma once

#include <cstdint>

#include "identification/advised_drive.h"
#include "identification/rollout_batch.h"

namespace mrose {

/// Open-loop errors over held-out drives, of networks that were learned from four calm minutes of the reference robot
/// (`before`), and of those that were learned from these and two minutes more: advised ones, ones at random as mrose
/// generate drives, or ones of commands drawn evenly over the robot's limits.
struct AdviceTrial {
    AdvisedDrive advice;
    OpenLoopError before, advised, random, even;
};
AdviceTrial adviceTrial(std::uint64_t seed, int epochs, const Log& heldOut, bool evenToo);

}  // namespace mrose
