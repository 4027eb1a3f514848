#pragma once

#include "behaviour/back_off.h"
#include "behaviour/ball_belief.h"
#include "behaviour/own_belief.h"
#include "control/controller.h"

namespace mrose {

// What the parts of a built-in controller's memory say at its last decision, `now`.

void explainSelf(const OwnBelief& self, Nanoseconds now, MemoryEntries& entries);
void explainBall(const BallBelief& ball, Nanoseconds now, MemoryEntries& entries);
void explainBackOff(const BackOff& backOff, Nanoseconds now, MemoryEntries& entries);

}  // namespace mrose
