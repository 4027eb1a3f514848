#pragma once

#include <cstdint>
#include <span>

#include "logs/measurements.h"

namespace mrose {

/// One of the counts of what a reader found and did, with its name in files and its words.
struct SensorDefectCount {
    std::int64_t SensorDefects::*count;
    const char *key, *one, *many, *done;
};
/// Of all of them.
std::span<const SensorDefectCount> sensorDefectCounts();

void addDefects(SensorDefects& sum, const SensorDefects& more);

}  // namespace mrose
