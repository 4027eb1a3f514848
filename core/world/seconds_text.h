#pragma once

#include <string>

#include "world/time.h"

namespace mrose {

/// "0.02": the shortest number that is so many seconds.
std::string plainSeconds(Nanoseconds duration);

/// Seconds without rounding, with as many decimals as it takes but at least `leastDecimals`.
std::string secondsText(Nanoseconds time, int leastDecimals = 1);

}  // namespace mrose
