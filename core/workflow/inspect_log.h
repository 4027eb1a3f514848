#pragma once

#include <string>
#include <vector>

#include "identification/log_inspection.h"
#include "io/error.h"
#include "io/progress.h"

namespace mrose {

/// Which log is to be looked through.
struct InspectRequest {
    std::string log;
    std::vector<std::string> robots = {};  ///< by name; empty: all
};

/// Error: the log cannot be read, has no such robot; it was cancelled.
Expected<LogInspection> inspectLog(const InspectRequest& request, const Progress& progress = {});

}  // namespace mrose
