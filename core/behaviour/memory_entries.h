#pragma once

#include <vector>

#include "behaviour/back_off.h"
#include "behaviour/ball_belief.h"
#include "behaviour/own_belief.h"
#include "control/controller.h"

namespace mrose {

// What the parts of a built-in controller's memory say at its last decision, `now`.

void explainSelf(const OwnBelief& self, Nanoseconds now, std::vector<MemoryEntry>& entries);
void explainBall(const BallBelief& ball, Nanoseconds now, std::vector<MemoryEntry>& entries);
void explainBackOff(const BackOff& backOff, Nanoseconds now, std::vector<MemoryEntry>& entries);

}  // namespace mrose
