#pragma once

#include <limits>
#include <string_view>

namespace mrose {

/// Both ends are possible.
struct ValueRange {
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
};

/// Between what an expression's values lie as far as its text alone says so; true is 1, false is 0: of "a < b" 0 to 1,
/// of "a < b and 100 or 0" 0 to 100, of "time" and "goals.left" from 0 on. Of one that Lua accepts.
ValueRange writtenRange(std::string_view text);

}  // namespace mrose
