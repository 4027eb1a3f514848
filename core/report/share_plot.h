#pragma once

#include <string_view>

#include "drawing/svg_plot.h"

namespace mrose {

/// A square of shares in %, predicted to the right and real upwards, with the diagonal on which they are the same.
SvgPlot sharePlot(std::string_view description, std::string_view xTitle, std::string_view yTitle);

}  // namespace mrose
