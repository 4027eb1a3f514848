#include "identification/robust_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrose {

double medianOf(std::vector<double> values) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

double robustSpread(std::vector<double> values, double centre) {
    for (double& value : values) value = std::abs(value - centre);
    constexpr double ofNormal = 1.482602218505602;
    return ofNormal * medianOf(std::move(values));
}

}  // namespace mrose
