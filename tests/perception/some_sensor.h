#pragma once

#include "perception/sensor_network.h"

namespace mrose::test {

/// A camera of two robots whose distributions depend on the state in some way: members of two components, with every
/// input that sensors of subjects have. The parameters are random.
SensorNetwork someCamera(std::uint64_t seed = 1, int members = 1);

/// Makes a network one of a single hidden unit that says the same of every state, by its inputs and form: the outputs
/// are these values, in their units and the order of the form; of those that are not given, 0.
void makeConstant(SensorNetwork& network, const std::vector<double>& outputs);
/// Of such a network, one that reports what is true of an input: always where that is well above `bound`, in its unit,
/// and never where it is well below.
void reportAbove(SensorNetwork& network, std::size_t input, double bound);

/// The camera of two robots, constant.
SensorNetwork constantCamera(const std::vector<double>& outputs, int components = 1);
/// What such robots say of where they are, constant.
SensorNetwork constantLocalisation(const std::vector<double>& outputs);

}  // namespace mrose::test
