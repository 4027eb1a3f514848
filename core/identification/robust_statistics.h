#pragma once

#include <vector>

namespace mrose {

/// NaN of none.
double medianOf(std::vector<double> values);

/// The standard deviation of a normal distribution of the same median distance to `centre`; NaN of none.
double robustSpread(std::vector<double> values, double centre);

}  // namespace mrose
