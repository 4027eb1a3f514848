#pragma once

#include "sensing/sensor.h"
#include "sensing/sensor_sources.h"

namespace mrose {

/// [[sensor]] of the kind "learned" in a robot file: a LearnedCamera or a LearnedLocaliser, by what its network
/// measures.
SensorPointer readLearnedSensor(TomlTable& table, const SensorTraits& traits, const SensorSources& sources);

}  // namespace mrose
