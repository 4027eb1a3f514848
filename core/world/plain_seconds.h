#pragma once

#include <string>

#include "world/time.h"

namespace mrose {

/// "0.02": the shortest number that is so many seconds.
std::string plainSeconds(Nanoseconds duration);

}  // namespace mrose
