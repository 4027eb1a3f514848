#pragma once

#include "perception/sensor_network.h"

namespace mrose::test {

/// A camera of two robots whose distributions depend on the state in some way: members of two components, with every
/// input that sensors of subjects have. The parameters are random.
SensorNetwork someCamera(std::uint64_t seed = 1, int members = 1);

/// One that says the same of every state: the outputs are these values, in their units and the order of its form.
SensorNetwork constantCamera(const std::vector<double>& outputs, int components = 1);

}  // namespace mrose::test
