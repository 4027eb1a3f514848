#pragma once

#include "world/time.h"

namespace mrose {

constexpr Nanoseconds ms = 1'000'000, second = nanosecondsPerSecond;

}  // namespace mrose
