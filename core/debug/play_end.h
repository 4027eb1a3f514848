#pragma once

#include <cstdint>
#include <string>

#include "debug/time_travel.h"

namespace mrose {

/// Where playing the shown branch stops: at the scenario's end, or where a branch has had time to show what became of
/// what was changed.
std::int64_t usualEnd(const TimeTravel& run);
/// What is to be said at the shown tick, where it ended.
std::string endText(const TimeTravel& run);

}  // namespace mrose
