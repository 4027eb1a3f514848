#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"

namespace mrose {

/// What was measured in reality, by trials: of `before` and of `after`, a number for each measure, NaN where it is not
/// known. The mean where a trial was measured several times.
using RealResults = std::map<std::uint32_t, std::array<std::vector<double>, 2>>;

/// A CSV whose first line names the columns `trial`, `when` (before or after) and the measures; others are passed over,
/// as are blanks around cells, empty rows and a byte order mark. Error: file and line of what is no such row; a column
/// is missing; a trial has not both.
Expected<RealResults> readRealResults(std::string_view text, const std::string& file,
                                      const std::vector<std::string>& measures);

}  // namespace mrose
