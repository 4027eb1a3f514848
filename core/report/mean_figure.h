#pragma once

#include <span>
#include <string>
#include <string_view>

#include "drawing/axis_ticks.h"
#include "experiment/estimates.h"

namespace mrose {

struct NamedMean {
    std::string name;
    Estimate mean;
    std::string_view cssClass = "sample";  ///< of its dot
};

/// A row for each, from above: its name, and a dot with its 95 % interval. `title`: of the axis, with its unit.
/// The axis does not leave what is possible.
std::string meanFigure(std::span<const NamedMean> means, std::string_view title, PlotRange possible = anyRange);

}  // namespace mrose
