#pragma once

#include "world/toml_values.h"

namespace mrose {

// Ranges of keys that sensors have in common.
constexpr NumberRange probability{0, 1};
/// Late sensors need the poses of so much of the past in every state.
constexpr NumberRange latencies{0, 1};  // s
constexpr NumberRange metresOff{0, 100};
constexpr NumberRange degreesOff{0, 360};

}  // namespace mrose
