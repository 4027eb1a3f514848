#pragma once

#include <string_view>
#include <vector>

#include "identification/sensor_samples.h"
#include "identification/sound_errors.h"
#include "learning/regressor.h"
#include "perception/sensor_network.h"

namespace mrose {

/// What a learned sensor reads of what is true, with the scales that the samples give.
std::vector<NetworkVariable> sensorInputsFor(const SensorNetwork& network, const SensorSamples& samples);

/// What the network says of a reading, standardised by all that are sound, so that zeros are a first guess of
/// everything. `network` says what it measures, and the form.
std::vector<NetworkVariable> sensorOutputsFor(const SensorNetwork& network, const SensorSamples& samples,
                                              const SoundErrors& sound);

/// Both halves of what is learned: whether there is a reading, from all cases; its error, from those with one.
enum class SensorHalf { reported, error };

/// Whether errors are learned from an input, too: from no more than shows in them, so that little is learned by heart.
/// Whether there is a reading is learned from all inputs.
bool isReadForErrors(std::string_view input);

/// Between which points a lookup table of these inputs interpolates: a grid over the geometry, one over it for each
/// robot, coarser, and one for each of the others that the half reads. Values are 0.
LookupTable sensorTableFor(const std::vector<NetworkVariable>& inputs, const SensorNetwork& network, SensorHalf half,
                           int outputs);

}  // namespace mrose
