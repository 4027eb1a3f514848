#pragma once

#include <string>

#include "debug/branch_setup.h"
#include "io/error.h"

namespace mrose {

/// The same setup with the network of a file as one robot's motion. Plug-ins go on in their processes. Error: it is no
/// network, or none for this robot.
Expected<BranchSetupPointer> withSwappedModel(const BranchSetup& setup, std::size_t robot, const std::string& file);

/// What the network's name is in the names of branches: the file's, without its folder.
std::string modelName(const std::string& file);

}  // namespace mrose
