#pragma once

#include <vector>

#include "diagnosis/divergence.h"

namespace mrose {

/// For how long before an instant commands still show in what a robot does then.
Nanoseconds commandsShowFor(const MotionModel& model);

/// Where a robot's command changes.
struct CommandJump {
    StampedCommand command;  ///< from there on
    Command before;
    Nanoseconds next = 0;  ///< of the next jump, on the log's clock; the end of the log where there is none
};

/// The jumps that may still act within a rollout, up to its divergence, in the order of time: of many, those with the
/// largest effect, measured in the bound. Commands that change by little again and again, as a stick's, are no jumps.
std::vector<CommandJump> commandJumpsNear(const Trajectory& trajectory, const MotionModel& model,
                                          const ComparedRollout& rollout, Nanoseconds divergence,
                                          const DivergenceBound::At& bound);

}  // namespace mrose
