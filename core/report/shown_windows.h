#pragma once

#include <string>
#include <vector>

#include "report/evaluation_report.h"

namespace mrose {

struct ShownWindow {
    std::size_t window = 0;
    std::string reason;  ///< "median window", "worst heading", ...
};

/// The windows whose paths a report shows, each once: the 10th, 50th, 75th and 90th percentile and the worst one by the
/// first model's time-mean position error over the path, the one with the worst heading at the end, the median of each
/// kind of manoeuvre, and those asked for. Windows without driving are ranked by heading where nothing drives.
std::vector<ShownWindow> shownWindows(const Evaluation& evaluation, const std::vector<std::size_t>& chosen);

}  // namespace mrose
