#pragma once

#include <string>
#include <vector>

#include "diagnosis/other_models.h"

namespace mrose {

/// Motion models to try instead of those of the compared robots: the network files named, as they are or as they ship;
/// the networks that ship for the same types of robots; the kinematics that the robots' networks are compared with.
/// Error: a named file that cannot be read.
Expected<std::vector<OtherModel>> modelsToTry(const LogWorld& world, const std::vector<std::string>& networks);

}  // namespace mrose
