#pragma once

#include <cstdint>
#include <optional>

#include "debug/time_travel.h"

namespace mrose {

/// The decision that led to a kick: where, and when it came about.
struct KickCause {
    KickEvent order;
    std::int64_t kicked = 0;  ///< tick of the state after it
};
/// Of the last kick up to the shown tick; nullopt: there was none.
std::optional<KickCause> causeOfKick(const TimeTravel& run);

}  // namespace mrose
