#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace mrose {

/// A name for every body, robots first, that plots and frames can go by: those of the scene with '_' for all but
/// letters, digits, '_' and '-', and with a number behind it where two would be the same or one is empty.
std::vector<std::string> bodyNames(const Scene& scene);

}  // namespace mrose
