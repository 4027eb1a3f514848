#pragma once

#include <span>
#include <string>
#include <string_view>

#include "experiment/estimates.h"

namespace mrose {

struct NamedMean {
    std::string name;
    Estimate mean;
    std::string_view cssClass = "sample";  ///< of its dot
};

/// A row for each, from above: its name, and a dot with its 95 % interval. `title`: of the axis, with its unit.
std::string meanFigure(std::span<const NamedMean> means, std::string_view title);

}  // namespace mrose
