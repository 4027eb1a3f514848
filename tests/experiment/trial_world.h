#pragma once

#include "scenario/scenario.h"

namespace mrose {

/// Two robots of random commands and a ball, with motion noise, in a walled field of 4 x 3 m with one goal: what one
/// trial does differs from the next, and soon.
ScenarioParts trialWorld();

}  // namespace mrose
