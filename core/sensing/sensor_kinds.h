#pragma once

#include <string_view>
#include <vector>

#include "io/toml_table.h"
#include "scene/perception.h"
#include "sensing/learned_kind.h"
#include "sensing/sensor.h"

namespace mrose {

/// The part [perception] of a robot file: the sensors that every robot has.
Perception readPerception(TomlTable table);
std::vector<SensorPointer> standardSensors(const Perception& perception);

/// A kind of sensor that a robot file may ask for: [[sensor]] with `kind`, `name`, `period_s` (none: at each control
/// instant), and the keys that `read` reads; what they refer to comes from
/// `sources`. `preset` names a file that has keys for it, which the table's own go before.
struct SensorKind {
    std::string_view name;
    SensorPointer (*read)(TomlTable& table, const SensorTraits& traits, const SensorSources& sources);
};
std::span<const SensorKind> sensorKinds();

/// A sensor as a table says, whose name and period were read; null after an error, which the table remembers.
SensorPointer readSensor(TomlTable& table, const SensorTraits& traits, const SensorSources& sources,
                         std::span<const SensorKind> kinds = sensorKinds());

/// The sensors that the tables [[sensor]] of a robot file ask for.
std::vector<SensorPointer> readSensors(std::vector<TomlTable> tables, const SensorSources& sources,
                                       std::span<const SensorKind> kinds = sensorKinds());

}  // namespace mrose
