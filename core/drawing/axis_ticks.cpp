#include "drawing/axis_ticks.h"

#include <algorithm>
#include <cmath>

namespace mrose {

PlotRange usable(PlotRange range) {
    if (!std::isfinite(range.low) || !std::isfinite(range.high) || range.high <= range.low)
        return {std::isfinite(range.low) ? range.low : 0, (std::isfinite(range.low) ? range.low : 0) + 1};
    return range;
}

PlotRange withRoom(PlotRange range, double share, PlotRange possible) {
    const double size = std::max(std::abs(range.low), std::abs(range.high)), length = range.high - range.low;
    const double room = length > 1e-9 * size ? share * length : size > 0 ? 0.1 * size : 1;
    return {std::max(possible.low, range.low - room), std::min(possible.high, range.high + room)};
}

AxisTicks axisTicks(PlotRange range, int wanted) {
    range = usable(range);
    const double raw = (range.high - range.low) / wanted;
    const double power = std::pow(10, std::floor(std::log10(raw)));
    const double lead = raw / power;
    AxisTicks ticks;
    ticks.step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
    ticks.decimals = std::max(0, static_cast<int>(-std::floor(std::log10(ticks.step) + 1e-9)));
    const auto first = static_cast<long>(std::ceil(range.low / ticks.step - 1e-9));
    for (long i = first; static_cast<double>(i) * ticks.step <= range.high + 1e-9 * ticks.step; ++i)
        ticks.values.push_back(static_cast<double>(i) * ticks.step);
    return ticks;
}

double roundStep(double least) {
    const double power = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

}  // namespace mrose
