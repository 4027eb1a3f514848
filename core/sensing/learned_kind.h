#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "io/toml_table.h"
#include "perception/learned_sensor.h"
#include "sensing/sensor.h"

namespace mrose {

/// Gives the sensor network that a table names by a key; null after an error, which the table remembers.
using SensorNetworkReader = std::function<std::shared_ptr<const LearnedSensor>(TomlTable& table, std::string_view key)>;

/// [[sensor]] of the kind "learned" in a robot file: a LearnedCamera or a LearnedLocaliser, by what its network
/// measures.
SensorPointer readLearnedSensor(TomlTable& table, const SensorTraits& traits, const SensorNetworkReader& networks);

}  // namespace mrose
