#pragma once

#include <string>
#include <vector>

#include "io/error.h"
#include "logs/robot_log.h"

namespace mrose {

/// The cause of an error of a log, followed by what looks like another unit in it.
std::string withUnitDoubts(std::string cause, const Log& log);

/// What in a CSV log looks like another unit than the format's, a sentence each: times so far apart that nothing is
/// known between poses, robots and balls that are faster, or turn faster, than any, sensors that see farther. Other
/// formats have units of their own.
std::vector<std::string> unitDoubts(const Log& log);

/// Error: positions of a robot of a CSV log cannot be in metres, since it would drive many times as fast as it is ever
/// told to, or faster than any robot; with the unit that they look like. Nothing can be learned from them.
Expected<void> checkMetres(const Log& log);

}  // namespace mrose
