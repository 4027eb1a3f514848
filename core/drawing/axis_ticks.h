#pragma once

#include <limits>
#include <vector>

namespace mrose {

struct PlotRange {
    double low = 0, high = 1;
};
/// One that can be drawn: from 0 on where it begins nowhere, one unit long where it has no length.
PlotRange usable(PlotRange range);
/// Nothing is beyond it.
inline constexpr PlotRange anyRange{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
/// With some room at both ends, though not beyond what is possible: a share of its length, or of its value where it has
/// no length.
PlotRange withRoom(PlotRange range, double share, PlotRange possible = anyRange);

/// Multiples of 1, 2 or 5 times a power of ten within [low, high], about `wanted` of them.
struct AxisTicks {
    std::vector<double> values;
    double step = 1;
    int decimals = 0;  ///< that tell them apart
};
AxisTicks axisTicks(PlotRange range, int wanted);

/// The least of 1, 2 and 5 times a power of ten that is not below.
double roundStep(double least);

}  // namespace mrose
