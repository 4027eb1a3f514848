#pragma once

#include "identification/sensor_samples.h"
#include "perception/learned_sensor.h"
#include "perception/reading_noise.h"

namespace mrose {

/// What readings have in common beyond what the network says of each: by products of the residuals of two readings, of
/// one look and of looks up to 20 s apart, of one subject and of different ones. Residuals of errors are normal scores
/// of their distributions; those of reports are seen against their probabilities, by the first terms of the tetrachoric
/// series.
ReadingNoises fitReadingNoises(const LearnedSensor& sensor, const SensorSamples& samples);

}  // namespace mrose
