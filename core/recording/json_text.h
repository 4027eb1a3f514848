#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "world/time.h"

namespace mrose {

/// Appends a number with at most this many decimals (0 ... 6); null where it is not finite.
void appendFixed(std::string& json, double value, int decimals);

/// Appends a text in quotes; bytes that are no UTF-8 as question marks.
void appendQuoted(std::string& json, std::string_view text);

/// Appends Foxglove's time: {"sec":1,"nsec":20000000}.
void appendTime(std::string& json, Nanoseconds time);

}  // namespace mrose
