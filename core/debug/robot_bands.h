#pragma once

#include <memory>
#include <optional>

#include "debug/played_log.h"
#include "simulation/motion_bands.h"

namespace mrose {

/// What may become of a run from any of its ticks on: robots that play a log are given its commands further on, all
/// others keep those in force.
MotionSampler samplerOf(std::shared_ptr<const Scenario> scenario);

/// Where the simulated robots of one rollout of a log may be, from its start on and for at most `longest`. nullopt: it
/// did not go on.
constexpr Nanoseconds longestRolloutBands = 60 * nanosecondsPerSecond;
std::optional<MotionBands> rolloutBands(const PlayedLog& log, const RolloutRequest& rollout, const GoesOn& goesOn,
                                        Nanoseconds longest = longestRolloutBands);

}  // namespace mrose
