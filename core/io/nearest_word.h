#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace mrose {

/// How far a word is from the one that it may be meant for: letters to add, drop, change or swap with the next. One
/// that lacks its unit ("start_x" of "start_x_m") is near.
std::size_t wordDistance(std::string_view a, std::string_view b);

/// The one of `known` that a misspelt word is meant for; empty: none is near.
std::string_view nearestWord(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace mrose
