#pragma once

#include <string>

#include "motion/motion_network.h"

namespace mrose {

/// What is known of a kind of robot beforehand and cannot be learned from its logs alone.
struct RobotTraits {
    std::string type;                      ///< the kind's name: "irobot-create"
    MotionNetwork::WheelPhase wheelPhase;  ///< quantum 0: wheel speeds are continuous
    double turnOffset = 0;                 ///< rad/s, as in MotionNetwork
    bool turnsOnTinyCommands = false;      ///< a tiny rotation rate is driven as a circle of the largest radius
    bool operator==(const RobotTraits&) const = default;
};

}  // namespace mrose
