#pragma once

#include <string_view>
#include <vector>

#include "identification/sensor_samples.h"
#include "learning/regressor.h"
#include "perception/sensor_network.h"

namespace mrose {

/// What a learned sensor reads of what is true, with the scales that the samples give.
std::vector<NetworkVariable> sensorInputsFor(const SensorNetwork& network, const SensorSamples& samples);

/// Whether the error of a reading is learned from an input, too; whether there is one is learned from all.
bool isReadForErrors(std::string_view input);

/// Between which points a lookup table of these inputs interpolates: a grid over the geometry, one over it for each
/// robot, coarser, and one for each of the others. Values are 0.
LookupTable sensorTableFor(const std::vector<NetworkVariable>& inputs, const SensorNetwork& network, int outputs);

}  // namespace mrose
