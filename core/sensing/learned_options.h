#pragma once

#include <optional>
#include <string>

#include "world/time.h"

namespace mrose {

/// What a robot file may say of a learned sensor beyond its network.
struct LearnedSensorOptions {
    /// Which of the network's robots it belongs to; nullopt: SceneRobot::motionRobot, where it was learned, else the
    /// mean of all.
    std::optional<std::string> robot;
    std::optional<Nanoseconds> latency;  ///< nullopt: the network's
};

}  // namespace mrose
