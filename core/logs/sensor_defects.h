#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "logs/measurements.h"

namespace mrose {

/// One of the counts of what a reader found and did, with its name in files and its words.
struct SensorDefectCount {
    std::int64_t SensorDefects::*count;
    const char *key, *one, *many, *done;
};
/// Of all of them.
std::span<const SensorDefectCount> sensorDefectCounts();

/// Of a sensor whose readings mostly lie more than 1 m or 0.15 rad off the ground truth, and what may be wrong then.
/// `robots`: whose it is, as "robot 1".
std::string misfitCause(const std::string& sensor, const std::string& robots, std::int64_t gross,
                        std::int64_t readings);

void addDefects(SensorDefects& sum, const SensorDefects& more);

}  // namespace mrose
