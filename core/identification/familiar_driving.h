#pragma once

#include <optional>
#include <span>

#include "identification/motion_samples.h"
#include "motion/motion_network.h"

namespace mrose {

/// The parts of the commands that describe the driving of such a network: the newest four periods of what it reads. The
/// scales are 1.
FamiliarDriving describedChannels(const MotionNetwork& network);

/// Where the driving lies that a network of this blueprint learns from, whose inputs say how far back. Prototypes are
/// chosen one by one, each where the patterns are farthest from all others. How far driving of the same kind is from
/// them is found by holding out the folds of `sampling` in turn. nullopt: too little to learn from and to hold out.
std::optional<FamiliarDriving> familiarDriving(std::span<const Log> logs, const MotionNetwork& blueprint,
                                               const SampleOptions& sampling);

}  // namespace mrose
