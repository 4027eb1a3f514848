#pragma once

#include <functional>
#include <memory>
#include <string_view>

#include "geometry/shape.h"
#include "io/toml_table.h"
#include "perception/learned_sensor.h"

namespace mrose {

/// What a description of a sensor may refer to.
struct SensorSources {
    /// The sensor network that a table names by a key; null after an error, which the table remembers.
    std::function<std::shared_ptr<const LearnedSensor>(TomlTable& table, std::string_view key)> network;
    /// The keys of the preset that a table names by a key; null likewise.
    std::function<const Value*(TomlTable& table, std::string_view key)> preset;
    /// That of the robot which carries it; null: not known.
    std::shared_ptr<const Shape> shape;
};

}  // namespace mrose
