#pragma once

#include <span>
#include <string>
#include <string_view>

#include "drawing/axis_ticks.h"
#include "experiment/estimates.h"

namespace mrose {

struct SweptMean {
    double at = 0;
    Estimate mean;
};

/// A curve over what was swept, in any order, with its 95 % band; it is broken, with a hollow mark on the axis, where a
/// mean is not known. Titles with their units. The upright axis does not leave what is possible.
std::string sweepFigure(std::span<const SweptMean> means, std::string_view xTitle, std::string_view yTitle,
                        PlotRange possible = anyRange);

}  // namespace mrose
