#pragma once

#include <string>
#include <vector>

#include "logs/robot_log.h"

namespace mrose {

/// What in a CSV log looks like another unit than the format's, a sentence each: times so far apart that nothing is
/// known between poses, robots that are faster, or turn faster, than any, sensors that see farther. Other formats have
/// units of their own.
std::vector<std::string> unitDoubts(const Log& log);

}  // namespace mrose
