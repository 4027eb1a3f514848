#pragma once

#include <string>

#include "io/error.h"
#include "logs/robot_log.h"
#include "motion/robot_traits.h"

namespace mrose::cli {

/// Of the kind that the command line names, by its name or by a robot file; "": of the one that the log names, without
/// traits where it names none. Error: no such kind.
Expected<RobotTraits> traitsOf(const std::string& type, const Log& log);

}  // namespace mrose::cli
