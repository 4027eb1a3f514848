#pragma once

#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "world/command.h"

namespace mrose {

/// Another body as a robot's sensors report it.
struct SeenBody {
    std::uint32_t index = 0;   ///< of the robot or the object
    Point position_B;          ///< in the observer's own frame at `measured`, m
    Nanoseconds measured = 0;  ///< when it was there
    bool operator==(const SeenBody&) const = default;
};

/// What a controller gets to see. It never sees the world's state.
struct Observation {
    std::uint32_t robot = 0;         ///< whose it is
    std::uint32_t manipulators = 0;  ///< how many it has
    Nanoseconds time = 0;            ///< now
    std::uint64_t noise = 0;         ///< 64 random bits of this instant, for who rolls dice
    bool localised = false;          ///< false until the first measurement of the own pose
    Pose self;                       ///< own pose in the world's frame, as measured last
    Nanoseconds selfMeasured = 0;
    Velocity velocity;              ///< own, by odometry, now
    std::vector<SeenBody> robots;   ///< those in sight, in the order of their indices
    std::vector<SeenBody> objects;  ///< the ball is index 0, where there is one
    bool operator==(const Observation&) const = default;
};

}  // namespace mrose
