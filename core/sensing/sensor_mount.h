#pragma once

#include <vector>

#include "sensing/sensor_sources.h"

namespace mrose {

/// Where a sensor is on its robot, in the robot's frame: `position_m`, `heading_deg`, by default at the reference
/// point, facing forward. It must be within the robot's outline.
Pose readMount(TomlTable& table, const SensorSources& sources);

/// Where the elements of a ring are: `ring = { count, radius_m, first_deg }`, spaced evenly and facing outward,
/// counter-clockwise from the first, or `elements`, an array of poses; at most `most`.
std::vector<Pose> readElements(TomlTable& table, const SensorSources& sources, std::size_t most);

}  // namespace mrose
