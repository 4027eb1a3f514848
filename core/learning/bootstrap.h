#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace mrose {

struct Interval {
    double low = 0, high = 0;
};

/// The 95 % interval of a statistic of `count` independent cases: by cases drawn with repetition, a thousand times. The
/// same for any number of threads, and the same draws whenever it is asked of as many. `statistic` gets the drawn
/// cases' indices; several threads call it.
Interval bootstrapInterval(std::size_t count, const std::function<double(std::span<const std::size_t>)>& statistic);

}  // namespace mrose
