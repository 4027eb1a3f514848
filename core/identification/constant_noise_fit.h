#pragma once

#include "identification/sensor_samples.h"
#include "perception/constant_noise.h"
#include "perception/sensor_network.h"

namespace mrose {

/// The likeliest constant noise of an ideal sensor, by the readings of landmarks without gross
/// errors, or of robots for one that reports no landmarks. `sensor` says what is in view
/// and which errors are gross.
ConstantNoise fitConstantNoise(const SensorNetwork& sensor, const SensorSamples& samples);

}  // namespace mrose
