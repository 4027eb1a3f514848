#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mrose {

/// What happened less its predicted median, and the central 90 % of what was predicted, likewise.
struct ResidualDot {
    double x = 0, off = 0, low = 0, high = 0;
};

/// The dots against x, with where the central 90 % lie in the mean of twelfths of them ("realdot", "s0"); without dots
/// a sentence that says so.
std::string residualFigure(std::vector<ResidualDot> dots, std::string_view title, std::string_view xTitle,
                           std::string_view yTitle);

}  // namespace mrose
