#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/error.h"

namespace mrose {

/// Which looks of a log's robots a learned sensor is to predict.
struct PredictReadingsRequest {
    std::string network, log;
    std::string queries;                   ///< a file that says which: readQueries()
    std::string output;                    ///< the CSV file of samples (sensorSamplesCsv())
    bool overwrite = false;                ///< of a file that is there already
    std::vector<std::string> robots = {};  ///< who is predicted, by name; empty: all. Every robot of the log occludes
    int samples = 40;
    std::uint64_t seed = 1;
};

struct PredictedReadings {
    std::size_t queries = 0;
    std::vector<std::string> notices;  ///< what must be known before they are believed
};

/// Error: a file; a query that the log has no ground truth for.
Expected<PredictedReadings> predictReadings(const PredictReadingsRequest& request);

}  // namespace mrose
