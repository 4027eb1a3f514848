#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace mrose {

/// Numbers of ticks in a row; NaN where one is unknown.
struct TickNumbers {
    std::int64_t first = 0;
    std::vector<float> values;

    std::int64_t end() const { return first + static_cast<std::int64_t>(values.size()); }
    float at(std::int64_t tick) const {  ///< NaN outside
        const bool known = tick >= first && tick < end();
        return known ? values[static_cast<std::size_t>(tick - first)] : std::numeric_limits<float>::quiet_NaN();
    }
};

}  // namespace mrose
