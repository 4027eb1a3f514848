#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "world/time.h"

namespace mrose {

/// Appends a number with so many decimals (0 ... 6), zeros too: messages whose numbers keep their width repeat at a
/// constant distance, by which they are compressed best. null where it is not finite.
void appendFixed(std::string& json, double value, int decimals);

/// Appends a text in quotes; bytes that are no UTF-8 as question marks.
void appendQuoted(std::string& json, std::string_view text);

/// Appends Foxglove's time: {"sec":1,"nsec":20000000}.
void appendTime(std::string& json, Nanoseconds time);

}  // namespace mrose
