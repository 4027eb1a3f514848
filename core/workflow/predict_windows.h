#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/error.h"
#include "io/progress.h"

namespace mrose {

/// Which windows of a log a network is to predict open loop.
struct PredictRequest {
    std::string network, log;
    std::string windows;                   ///< a file that says which: readWindows()
    std::string output;                    ///< the CSV file of poses (PredictionsCsv); empty: it is written nowhere
    bool overwrite = false;                ///< of a file that is there already
    std::vector<std::string> robots = {};  ///< of the log, by name; empty: all
    double horizon = 10;                   ///< of a window, s
    int samples = 0;                       ///< of each window, from sampleSeed() of `seed`; 0: the mean alone
    std::uint64_t seed = 1;
    std::vector<double> at = {};  ///< s after a window's start that are written; empty: every step
};

struct PredictedWindows {
    std::size_t windows = 0;
    std::string csv;
    std::vector<std::string> notices;  ///< what must be known before they are believed
};

/// Error: a file; the horizon or an instant is no whole number of steps; samples of a network without noise; a window
/// that the log does not have; it was cancelled.
Expected<PredictedWindows> predictWindows(const PredictRequest& request, const Progress& progress = {});

}  // namespace mrose
