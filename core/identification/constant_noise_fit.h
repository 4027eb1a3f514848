#pragma once

#include "identification/sensor_samples.h"
#include "identification/sound_errors.h"
#include "perception/constant_noise.h"
#include "perception/sensor_network.h"

namespace mrose {

/// The likeliest constant noise of an ideal sensor, by the sound readings of landmarks, or of robots for one that
/// reports no landmarks. `sensor` says what is in view.
ConstantNoise fitConstantNoise(const SensorNetwork& sensor, const SensorSamples& samples, const SoundErrors& sound);

}  // namespace mrose
