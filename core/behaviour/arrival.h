#pragma once

#include <array>
#include <cstdint>

#include "behaviour/own_belief.h"
#include "control/observation.h"
#include "world/command.h"

namespace mrose {

/// How far a robot has got with coming to rest at a pose: it approaches its place, turns on the spot, and rests, until
/// its belief says that it is elsewhere. Part of a controller's memory; all zero it approaches.
struct Arrival {
    enum Phase : std::int64_t { approaching, aligning, resting, backingOff };
    static constexpr std::array names{"approaching", "aligning", "resting", "backing off"};

    struct Tolerances {
        double position = 0.05, heading = 0.1;  ///< m, rad
        bool backwards = false;                 ///< may come tail first
    };

    std::int64_t phase;
    std::int64_t tailFirst;

    /// By where the robot will be when its command of now takes effect.
    void update(const Pose& ahead, const Pose& goal, const OwnBelief& self, const Tolerances& tolerances);
};
static_assert(sizeof(Arrival) == 2 * 8, "without padding");

/// Turns on the spot to a heading; `rotation`: rad/s at most.
Command turnTo(double heading, const Pose& ahead, double rotation);

/// Whether a robot has come to a stop, by its odometry.
bool standsStill(const Velocity& velocity);

}  // namespace mrose
