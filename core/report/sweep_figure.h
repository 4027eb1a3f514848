#pragma once

#include <span>
#include <string>
#include <string_view>

#include "experiment/estimates.h"

namespace mrose {

struct SweptMean {
    double at = 0;
    Estimate mean;
};

/// A curve over what was swept, in any order, with its 95 % band; it is broken, with a hollow mark on the axis, where a
/// mean is not known. Titles with their units.
std::string sweepFigure(std::span<const SweptMean> means, std::string_view xTitle, std::string_view yTitle);

}  // namespace mrose
