#pragma once

#include <functional>
#include <string>

#include "debug/opened_run.h"
#include "io/error.h"
#include "io/progress.h"

namespace mrose {

/// How a long opening is watched and ended.
struct OpenProgress {
    GoesOn goesOn = [] { return true; };
    std::function<void(const std::string& file)> reads = [](const std::string&) {};
};

/// Opens a scenario or a recording. Error: the first thing wrong in any file that it is made from.
Expected<OpenedRun> openRun(const OpenRequest& request, const OpenProgress& progress = {});

}  // namespace mrose
