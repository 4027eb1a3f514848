#pragma once

#include <functional>
#include <string>

#include "io/error.h"
#include "io/progress.h"
#include "tuning/tuning_file.h"
#include "tuning/tuning_output.h"
#include "tuning/tuning_run.h"
#include "workflow/plugins.h"

namespace mrose {

/// A tuning that is to be made.
struct TuneRequest {
    std::string file;    ///< or the name of one that ships
    std::string folder;  ///< for its files; made where it is missing
    PluginUse plugins = {};
    std::string command = {};  ///< what the settings say that they were made by
};

/// How it is watched and ended; see TuningOptions. Each may be empty.
struct TuneWatch {
    std::function<void(const Tuning&)> opened = {};
    std::function<void(const RunKey&)> runBegins = {};
    std::function<void(std::int64_t done, std::int64_t all, double best)> progress = {};
    GoesOn goesOn = {};
};

struct TunedBehaviour {
    Tuning tuning;
    TuningSummary summary;
};

/// Searches, and judges what was found in trials held out; when that is complete, writes settings.toml,
/// candidates.csv and report.html beside the rows of all runs. Error: as of readTuning() and runTuning(); a file cannot
/// be written.
Expected<TunedBehaviour> tuneBehaviour(const TuneRequest& request, const TuneWatch& watch = {});

}  // namespace mrose
