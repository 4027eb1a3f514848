#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace mrose {

/// The largest distance of the distribution of some numbers from an even one in (0, 1), times the root of their count:
/// above 1.63 in one of a hundred cases where they are even (Kolmogorov).
inline double kolmogorov(std::vector<double> numbers) {
    std::sort(numbers.begin(), numbers.end());
    const auto n = static_cast<double>(numbers.size());
    double most = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto k = static_cast<double>(i);
        most = std::max({most, numbers[i] - k / n, (k + 1) / n - numbers[i]});
    }
    return most * std::sqrt(n);
}

}  // namespace mrose
