#pragma once

#include <string>
#include <vector>

#include "io/progress.h"
#include "perception/sensor_network.h"

namespace mrose {

/// Learns what `network` (of the file `path`) is of by the other families of regressors, in their order: from the same
/// logs, found as given or by their names, with the same robots, latency and seed, and otherwise as `mrose train` does.
/// Error: a log that is not found or has other content; learning; ended by `progress`.
Expected<std::vector<SensorNetwork>> learnOtherFamilies(const SensorNetwork& network, const std::string& path,
                                                        const Progress& progress);

/// "lookup table".
std::string describedFamily(RegressorFamily family);

}  // namespace mrose
